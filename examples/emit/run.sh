#!/bin/sh
# Makes a suburb, writes emit.json beside it and renders that with build/ifov. The two-line elements were made for the example, so that the
# station passes there; the Sun stands where the suburb's own document has it.
set -eu
here=$(dirname "$0")
program=${IFOV_PROGRAM:-$here/../../build/ifov}
folder=${1:-build/emit}
[ -e "$folder/scene.json" ] || "$program" make suburb --size 1000m --seed 7 "$folder"
cp "$here/iss.tle" "$folder"
cat > "$folder/emit.json" <<'DOCUMENT'
{
  // EMIT's channels over a suburb from the International Space Station, line by line on its orbit: 14 x 14 pixels of 62 m, 285 channels.
  "ifov": 1,
  "include": "scene.json",
  "time": "2026-06-21T10:38:00Z",
  "scene": {"origin": {"latitude": "45.0 deg", "longitude": "7.0 deg"}},
  "platform": {"orbit": {"frame": "teme", "file": "iss.tle"}},
  "sensor": {
    "preset": "EMIT",
    "camera": {"pushbroom": {"pixels": [14, 14], "focal_length": "193.5 mm", "pitch": "30 um", "line_period": "8.6 ms", "start": "-60 ms"}}
  },
  "sampling": {"accuracy": {"error": "7 %"}},
  "output": {"formats": ["envi", "png", "html", "glt"]}
}
DOCUMENT
"$program" render "$folder/emit.json" --output "$folder/emit.out"
