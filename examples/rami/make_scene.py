#!/usr/bin/python3
"""Documents of RAMI's HET01 (Pinty et al. 2001, 2004), one for each view angle, or, with --one, one for all of them:
make_scene.py DATA FOLDER [--one] [ANGLE ...]

DATA holds the files of the intercomparison: `het01_UNI_sphere.def` (radius, centre and normal of each of 49,999 leaf
discs of a ball), `het01_UNI_instances.def` (centres of the 15 balls) and, where no angles are named,
`expected_brf.csv`. An angle is the view zenith in degrees in the principal plane, negative on the Sun's side.

With --one, `het01.json` tells the reflectance factors of the 100 m x 100 m that repeat without end towards each angle of
`angles.csv`. Without, the 8 x 8 pixels of an image hold them; the mean L of their radiances is the
reflectance factor pi L / (E cos 20 degrees), with E = 1 W m-2 um-1.
"""

import json
import pathlib
import sys

import numpy as np

SIDE_M = 100.0
SUN_ZENITH_DEG = 20.0
GROUND, LEAF_REFLECTANCE, LEAF_TRANSMITTANCE = 0.159, 0.4957, 0.4409
PIXELS = 8  # along a side
# Of each pixel, at a confidence of 95 %: 1.5 % standard error, and so 0.19 % of their mean.
HALF_WIDTH_PERCENT = 3


def write_leaves(discs, path):
    """The list of instances of a disc of 1 m radius that faces up: docs/formats/instances.md."""
    record = np.dtype([("at", "<f4", 3), ("turn", "<f4", 4), ("size", "<f4")])
    normal = discs[:, 4:] / np.linalg.norm(discs[:, 4:], axis=1, keepdims=True)
    # From z to the normal by half the way about the axis between them; a disc is the same about its own axis.
    half = normal + [0.0, 0.0, 1.0]
    length = np.linalg.norm(half, axis=1)
    facing_down = length < 1e-6
    half[facing_down] = [1.0, 0.0, 0.0]
    half /= np.linalg.norm(half, axis=1, keepdims=True)
    leaves = np.zeros(len(discs), record)
    leaves["at"] = discs[:, 1:4]
    leaves["turn"][:, 0] = half[:, 2]
    leaves["turn"][:, 1:] = np.cross([0.0, 0.0, 1.0], half)
    leaves["turn"][facing_down] = [0.0, 1.0, 0.0, 0.0]
    leaves["size"] = discs[:, 0]
    header = np.zeros(1, np.dtype([("magic", "S8"), ("order", "<u4"), ("version", "<u4"), ("count", "<u8"),
                                   ("bytes", "<u4"), ("layout", "u1", 4), ("origin", "<f8", 3), ("rest", "<u8")]))
    header[0] = (b"IFOVINST", 0x01020304, 1, len(leaves), record.itemsize, (1, 3, 1, 0), (0, 0, 0), 0)
    path.write_bytes(header.tobytes() + leaves.tobytes())


def document_of_all(balls, angles, folder):
    """The views' own error is asked for: 0.5 % at 95 %. Angles lie in the principal plane, negative on the Sun's side."""
    lines = [f"{angle:g},270\n" for angle in angles]
    (folder / "angles.csv").write_text("view_zenith_deg,view_azimuth_deg\n" + "".join(lines))
    described = document(balls, 0.0)
    described["sensor"] = {"distant": {"file": "angles.csv"}, "channels": described["sensor"]["channels"]}
    described["sampling"] = {"accuracy": {"error": "0.5 %"}}
    described["output"] = {"formats": ["envi"]}
    return described


def document(balls, angle):
    return {
        "ifov": 1,
        "scene": {
            "periodic": {"size": [f"{SIDE_M} m"] * 2},
            "materials": {
                "leaf": {"reflectance": LEAF_REFLECTANCE, "transmittance": LEAF_TRANSMITTANCE},
                "ground": {"reflectance": GROUND},
            },
            "prototypes": {
                "leaf": [{"disk": {"center": ["0 m"] * 3, "normal": [0, 0, 1], "radius": "1 m"}, "material": "leaf"}],
                "ball": [{"instances": {"of": "leaf", "binary": "leaves.ifovinst"}}],
            },
            "objects": [
                {"plane": {}, "material": "ground"},
                {"instances": {"of": "ball", "at": [[f"{x} m" for x in ball] for ball in balls.tolist()]}},
            ],
        },
        "light": {"sun": {"point": {"zenith": f"{SUN_ZENITH_DEG} deg", "azimuth": "90 deg", "distance": "1 au",
                                    "spectrum": "1 W m-2 um-1"}}, "sky": {"none": {}}},
        "sensor": {
            "camera": {"orthographic": {"gsd": f"{SIDE_M / PIXELS} m", "pixels": [PIXELS, PIXELS], "view_zenith": f"{abs(angle)} deg",
                                        "view_azimuth": "90 deg" if angle < 0 else "270 deg"}},
            "channels": [{"name": "near infrared", "monochromatic": {"at": "0.8 um"}}],
        },
        "sampling": {"accuracy": {"error": f"{HALF_WIDTH_PERCENT} %"}, "tile": 2},
        "output": {"formats": ["envi"], "products": ["standard_error", "half_width"]},
    }


def main():
    data, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    words = sys.argv[3:]
    one = words[:1] == ["--one"]
    angles = [float(word) for word in words[one:]]
    if not angles:
        angles = np.loadtxt(data / "expected_brf.csv", delimiter=",", skiprows=1)[:, 0].tolist()
    folder.mkdir(parents=True, exist_ok=True)
    write_leaves(np.loadtxt(data / "het01_UNI_sphere.def"), folder / "leaves.ifovinst")
    balls = np.loadtxt(data / "het01_UNI_instances.def")
    if one:
        (folder / "het01.json").write_text(json.dumps(document_of_all(balls, angles, folder), indent=1) + "\n")
        return
    for angle in angles:
        (folder / f"het01_{angle:+03.0f}.json").write_text(json.dumps(document(balls, angle), indent=1) + "\n")


if __name__ == "__main__":
    main()
