#!/bin/sh
# Renders both documents of this folder with build/ifov, where the reference data that they name is there.
set -eu
here=$(dirname "$0")
data=$here/../../../shared/truth
program=${IFOV_PROGRAM:-$here/../../build/ifov}
if [ ! -e "$data/scenes/buildings-cityjson/delft.json" ]; then
  echo "delft skipped: no reference data at $data"
  exit 0
fi
for document in sentinel2_10m half_metre; do
  "$program" render "$here/$document.json" --output "${1:-build/delft}/$document"
done
