#!/bin/sh
# Installs the Debian packages listed in tools/debian_packages.txt that are missing, and says which.
# Asks dpkg first: where all are there it needs neither network nor rights.
set -eu
list=$(dirname "$0")/debian_packages.txt

if ! command -v dpkg-query >/dev/null 2>&1; then
  echo "This is not a Debian system: install what $list names by your own means (or its counterparts)." >&2
  exit 0
fi

missing=
for package in $(sed 's/#.*//' "$list"); do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

echo "Installing the Debian packages that ifov needs and this system lacks:"
for package in $missing; do
  awk -v package="$package" '$1 == package { print "  " $0 }' "$list"
done

if [ "$(id -u)" -eq 0 ]; then
  as_root=
elif command -v sudo >/dev/null 2>&1; then
  as_root=sudo
else
  echo "Neither root nor sudo here. As root, run:" >&2
  echo "  apt-get install --no-install-recommends$missing" >&2
  exit 1
fi

# A file, so that a failure shows all that apt-get said and a success stays quiet.
log=$(mktemp)
trap 'rm -f "$log"' EXIT
run_apt() {
  if ! $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q "$@" >"$log" 2>&1 </dev/null; then
    cat "$log" >&2
    echo "apt-get $1 failed (see above). Missing:$missing" >&2
    exit 1
  fi
}
run_apt update
# shellcheck disable=SC2086  # a list of packages, split on purpose
run_apt install -y --no-install-recommends $missing
echo "Installed."
