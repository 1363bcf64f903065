#!/bin/sh
# Makes a suburb and renders emit.json.in over it with build/ifov.
set -eu
here=$(dirname "$0")
program=${IFOV_PROGRAM:-$here/../../build/ifov}
folder=${1:-build/emit}
[ -e "$folder/scene.json" ] || "$program" make suburb --size 1000m --seed 7 "$folder"
cp "$here/emit.json.in" "$folder/emit.json"
cp "$here/iss.tle" "$folder"
"$program" render "$folder/emit.json" --output "$folder/emit.out"
