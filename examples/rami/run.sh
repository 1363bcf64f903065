#!/bin/sh
# Renders some angles of RAMI's HET01 with build/ifov, where the reference data are there.
set -eu
here=$(dirname "$0")
data=$here/../../../shared/truth/rami/het01
program=${IFOV_PROGRAM:-$here/../../build/ifov}
out=${1:-build/rami}
if [ ! -e "$data/het01_UNI_sphere.def" ]; then
  echo "rami skipped: no reference data at $data"
  exit 0
fi
"$here/make_scene.py" "$data" "$out" --one -61 -21 1 61
"$program" render "$out/het01.json" --set sampling.accuracy.error='"2 %"'
"$here/make_scene.py" "$data" "$out" -61 -21 1 61
for angle in -61 -21 +01 +61; do
  "$program" render "$out/het01_$angle.json"
done
