#!/usr/bin/env python3
"""Gives files that others made to every reader of the program that their kind may be given to.

For each file small documents that use it are checked, and rendered where they are taken. A find is a crash, a hang,
exit code 3, more than 5 s of processor time, more than 512 MiB of memory, 8 KB of words, or an error that does not say
where.
See docs/developer/testing.md."""

import argparse
import collections
import concurrent.futures
import copy
import csv
import hashlib
import json
import os
import pathlib
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "fuzz" / "documents"))
import running  # noqa: E402

PLACED = {"low_left": ["-4 m", "-3 m"], "size": ["8 m", "6 m"]}
POST = {"box": {"low": ["0 m", "0 m", "0 m"], "high": ["1 m", "1 m", "1 m"]}, "material": "ground"}
AREA = {"low": ["-4 m", "-4 m"], "high": ["4 m", "4 m"]}
BASE = {
    "ifov": 1, "time": "2024-06-21T10:30:00Z",
    "scene": {"origin": {"latitude": "49 deg", "longitude": "8 deg"},
              "materials": {"ground": {"reflectance": 0.3, "temperature": "20 degC"}},
              "objects": [{"plane": {}, "material": "ground"}]},
    "light": {"sun": {"point": {"zenith": "40 deg", "azimuth": "120 deg"}}, "sky": {"temperature": "250 K"}},
    "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [8, 6]}},
               "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}},
                            {"name": "T", "monochromatic": {"at": "10 um"}}]},
    "sampling": {"accuracy": {"error": "5 %", "max_samples": 200}},
    "output": {"formats": ["envi", "png"], "products": ["half_width", "abundance"]},
}


def thing(shape):
    """A use that adds an object of this shape."""
    return lambda file: ("scene.objects", [*BASE["scene"]["objects"], {**shape(file), "material": "ground"}])


def copies(file):
    return [("scene.prototypes", {"post": [POST]}), ("scene.objects", [{"instances": {"of": "post", **file}}])]


def spectrum(keys):
    return lambda file: ("scene.materials.ground.reflectance", {**keys(file), "outside": "extend"})


def temperature(by):
    return lambda file: ("scene.materials.ground.temperature", {"map": {"file": file, "unit": "K", **by}})


def texture(file):
    curves = [{"table": {"wavelength": ["0.4 um", "15 um"], "values": [low, low]}} for low in (0.1, 0.2, 0.3)]
    image = {"file": file, "from": "0.6 um", "to": "0.7 um", **PLACED}
    return [("scene.materials.ground.reflectance", curves), ("scene.materials.ground.texture", {"images": [image]})]


def scattered(file):
    scatter = {"of": "post", "density": {"file": file, "unit": "0.0001 m-2", **PLACED}, "area": AREA}
    return [("scene.prototypes", {"post": [POST]}), ("scene.objects", [{"random_placement": scatter}])]


def materials(key, value):
    return lambda file: ("scene.objects", [{"plane": {}, "material": {key: {"file": file, **PLACED, **value}}}])


# What a file is given to: a change of BASE, or several, as (keys, value).
MESHES = {
    "mesh": thing(lambda file: {"mesh": {"file": file}}),
    "mesh in cm": thing(lambda file: {"mesh": {"file": file, "unit": "cm", "up": "y"}}),
    "prototype": lambda file: [("scene.prototypes", {"post": [{"mesh": {"file": file}, "material": "ground"}]}),
                               ("scene.objects", [{"random_placement": {"of": "post", "density": "0.1 m-2", "area": AREA}}])],
}
RASTERS = {
    "elevation": thing(lambda file: {"terrain": {"file": file, "nodata": "fill", **PLACED}}),
    "elevation, own place": thing(lambda file: {"terrain": {"file": file, "detail": "1 m"}}),
    "elevation, grid": thing(lambda file: {"terrain": {"file": file, "form": "grid", **PLACED}}),
    "material map": materials("map", {"classes": {str(k): "ground" for k in range(256)}}),
    "mixture map": materials("mixture", {"materials": ["ground"]}),
    "temperature map": temperature(PLACED),
    "temperature map, own place": temperature({}),
    "texture": texture,
    "heights": lambda file: ("scene.materials.ground.relief", {"heights": {"file": file, "unit": "1 mm", **PLACED}}),
    "normals": lambda file: ("scene.materials.ground.relief", {"normals": {"file": file, **PLACED}}),
    "density map": scattered,
    "PSF": lambda file: ("sensor.psf", {"kernel": {"file": file, "samples_per_pixel": 64}}),
}
TEXTS = {
    "CSV spectrum": spectrum(lambda file: {"csv": file, "wavelength_unit": "nm"}),
    "percent": spectrum(lambda file: {"csv": file, "wavelength_unit": "um", "scale": 0.01}),
    "ECOSTRESS spectrum": spectrum(lambda file: {"ecostress": file}),
    "USGS spectrum": spectrum(lambda file: {"usgs": file}),
    "DIRSIG spectrum": spectrum(lambda file: {"ems": file}),
    "channel": lambda file: ("sensor.channels",
                             [{"name": "red", "tabulated": {"file": file, "wavelength_unit": "nm"}}]),
    "rows of copies": lambda file: copies({"csv": file}),
    "weather": lambda file: ("weather", {"file": file, "date": "2024-06-21"}),
    "atmosphere": lambda file: ("atmosphere", {"imported": {"files": [file]}}),
    "irradiance": lambda file: ("light.sun.point.spectrum",
                                {"csv": file, "wavelength_unit": "nm", "unit": "W m-2 nm-1", "outside": "extend"}),
}
JSONS = {
    "city": thing(lambda file: {"city": {"file": file}}),
    "included document": lambda file: ("include", file),
    "document": lambda file: [],
    "atmosphere": TEXTS["atmosphere"],
}
SPECTRA = {
    "ASD spectrum": spectrum(lambda file: {"asd": file}),
    "ENVI library": spectrum(lambda file: {"sli": file, "spectrum": 1}),
    "list of copies": lambda file: copies({"binary": file}),
}
KINDS = [
    ({".obj", ".ply", ".gltf", ".glb"}, MESHES),
    ({".json", ".geojson"}, JSONS),
    ({".tif", ".tiff", ".nc", ".grd", ".jp2", ".pgm", ".ppm"}, RASTERS),
    ({".bmp", ".png", ".jpg", ".jpeg", ".gif", ".webp"}, RASTERS),
    ({".img", ".hdr", ".asc", ".dem", ".bil"}, {**RASTERS, **TEXTS, **SPECTRA}),
    ({".asd", ".sli", ".ifovinst"}, SPECTRA),
    ({".csv", ".tsv", ".txt", ".dat", ".epw", ".ems", ".mat", ".atm", ".spc"}, TEXTS),
    ({".out", ".inp", ".tp5", ".tp6", ".tp7", ".7sc", ".chn"}, TEXTS),
]


def uses(file):
    """What the file may be given to, by its ending; one that tells nothing: whatever does not look at it."""
    for endings, readers in KINDS:
        if file.suffix.lower() in endings:
            return readers
    return {**TEXTS, **JSONS, **SPECTRA, "elevation": RASTERS["elevation"]}


def document(use, name):
    made = copy.deepcopy(BASE)
    changes = use(name)
    for keys, value in [changes] if isinstance(changes, tuple) else changes:
        *path, last = keys.split(".")
        place = made
        for key in path:
            place = place[key]
        place[last] = value
    return made


def try_file(program, file, limits):
    """Rows of (file, reader, command, exit code, processor time in s, MiB, faults)."""
    rows = []
    with tempfile.TemporaryDirectory(prefix="ifov_foreign_") as folder:
        folder = pathlib.Path(folder)
        (folder / "files").symlink_to(file.parent.resolve())  # with what lies beside it
        name = f"files/{file.name}"
        for reader, use in uses(file).items():
            (folder / "document.json").write_text(json.dumps(document(use, name)))
            given = name if reader == "document" else "document.json"
            for command in (["check", given], ["render", given, "--output", "out", "--threads", "1", "--restart"]):
                ended = running.run([program, *command, "--no-cache"], folder, limits)
                faults = running.faults(ended, limits)
                rows.append((file, reader, command[0], ended.code, round(ended.processor_s, 3),
                             round(ended.resident_mib), "; ".join(faults)))
                if ended.code not in (0, 6) or reader == "document":  # a document of theirs may ask for anything
                    break
            shutil.rmtree(folder / "out", ignore_errors=True)
    return rows


def different(folders):
    """Files in the folders, of those that are the same the first."""
    seen = set()
    for folder in folders:
        for file in sorted(path for path in folder.rglob("*") if path.is_file()) if folder.is_dir() else [folder]:
            content = hashlib.sha256(file.read_bytes() + file.suffix.encode()).digest()
            if content not in seen:
                seen.add(content)
                yield file


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=pathlib.Path, help="files, or folders of them")
    program = pathlib.Path(os.environ.get("IFOV_PROGRAM", ROOT / "build" / "ifov"))
    parser.add_argument("--program", type=pathlib.Path, default=program)
    parser.add_argument("--jobs", type=int, default=1, help="files at a time")
    parser.add_argument("--table", type=pathlib.Path, help="a CSV file of all runs")
    options = parser.parse_args()
    limits = running.Limits(address_mib=None)  # memory is judged by what is in use
    files, counts, rows = list(different(options.folders)), collections.Counter(), []
    with (concurrent.futures.ThreadPoolExecutor(options.jobs) as pool,
          open(options.table or os.devnull, "w", newline="") as table):
        csv.writer(table).writerow(("file", "reader", "command", "exit code", "processor s", "MiB", "faults"))
        for tried in pool.map(lambda file: try_file(options.program.resolve(), file, limits), files):
            for row in tried:
                counts[f"exit code {row[3]}"] += 1
                if row[-1]:
                    print("find:", *row, flush=True)
            csv.writer(table).writerows(tried)
            table.flush()
            rows += tried
    found = {row[0] for row in rows if row[-1]}
    told = ", ".join(f"{what}: {count}" for what, count in sorted(counts.items()))
    print(f"files: {len(files)}; runs: {len(rows)};", told)
    for what, place in (("processor time", 4), ("memory", 5)):
        print(f"most {what}:", *max(rows, key=lambda row: row[place])[:6])
    print(f"finds: {len(found)} files")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
