#!/bin/sh
# Renders the Heidelberg documents with build/ifov, where the reference data that they name is there.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
data=${IFOV_TRUTH:-$here/../../../shared/truth}
program=${IFOV_PROGRAM:-$here/../../build/ifov}
if [ ! -e "$data/scenes/dem/dem_hd.tif" ] || [ ! -e "$data/scenes/helios/trees" ]; then
  echo "heidelberg skipped: no reference data at $data"
  exit 0
fi
folder=${1:-build/heidelberg}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
/usr/bin/python3 "$here/make_scene.py" "$data" "$folder"
data=$(cd "$data" && pwd)
for name in sentinel2 valley; do
  sed -e "s|@DATA@|$data|g" "$here/$name.json.in" > "$folder/$name.json"
  "$program" render "$folder/$name.json" --output "$folder/$name"
done
