#!/bin/sh
# Makes BUILD/venv, a virtual environment with the Python package and what its tests use, on the libifov that is in BUILD.
# What it needs from PyPI it asks for where that has changed. Where it cannot be had, BUILD/venv.missing says why, for the tests.
set -eu
build=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
venv=$build/venv
python=$(command -v /usr/bin/python3 || command -v python3)
log=$build/venv.log

give_up() {
  sed 's/^/  /' "$log" | tail -n 12 >&2
  echo "The Python package was not made: $1 ($log)." | tee "$build/venv.missing" >&2
  rm -f "$venv/ready"
  exit 1
}

pip() {
  "$venv/bin/python" -m pip --disable-pip-version-check --no-input "$@" >>"$log" 2>&1
}

: >"$log"
wanted=$(cksum <pyproject.toml)
if [ "$(cat "$venv/packages" 2>/dev/null)" != "$wanted" ]; then
  rm -rf "$venv"
  "$python" -m venv "$venv" >>"$log" 2>&1 || give_up "python3 -m venv failed"
  packages=$("$python" - <<'PYTHON'
import tomllib
settings = tomllib.load(open("pyproject.toml", "rb"))
extra = settings["project"]["optional-dependencies"]
wanted = settings["build-system"]["requires"] + settings["project"]["dependencies"] + extra["all"] + extra["test"]
print("\n".join(package for package in wanted if not package.startswith("ifov[")))
PYTHON
)
  echo "Fetching the Python packages that ifov's package needs into $venv:" $packages
  # shellcheck disable=SC2086  # a list of packages, split on purpose
  pip install --retries 1 --timeout 15 $packages || give_up "PyPI has not given its packages"
  echo "$wanted" >"$venv/packages"
fi

now=$(cat pyproject.toml CMakeLists.txt python/CMakeLists.txt python/src/* python/ifov/*.py* "$build"/libifov.so.*.*.* | cksum)
if [ "$(cat "$venv/ready" 2>/dev/null)" != "$now" ]; then
  pip install --no-build-isolation --no-deps --no-index --force-reinstall --config-settings "build-dir=$build/python" \
    --config-settings "cmake.define.IFOV_BUILD=$build" . || give_up "it could not be built"
  echo "$now" >"$venv/ready"
fi
rm -f "$build/venv.missing"
