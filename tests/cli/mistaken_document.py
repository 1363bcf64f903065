"""A good document, and what tables of mistakes make others of it with."""

import copy
import re

GOOD = {
    "ifov": 1,
    "scene": {
        "materials": {
            "lawn": {"reflectance": 0.12, "temperature": "22 degC"},
            "wall": {"reflectance": 0.5, "temperature": "30 degC"},
        },
        "objects": [
            {"plane": {}, "material": "lawn"},
            {"name": "house", "box": {"low": ["-4 m", "-3 m", "0 m"], "high": ["4 m", "3 m", "5 m"]}, "material": "wall"},
        ],
    },
    "light": {
        "sun": {"disc": {"zenith": "45 deg", "azimuth": "225 deg"}},
        "sky": {"temperature": "260 K"},
        "surroundings": {"reflectance": 0.12, "temperature": "22 degC"},
    },
    "sensor": {
        "camera": {"orthographic": {"gsd": "1 m", "pixels": [16, 12]}},
        "channels": [
            {"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "40 nm"}},
            {"name": "thermal", "top_hat": {"from": "10 um", "to": "12 um"}},
        ],
    },
    "sampling": {"accuracy": {"error": "2 %"}},
    "output": {"formats": ["envi"]},
}

FRAME = {
    "focal_length": "50 mm",
    "pitch": "10 um",
    "pixels": [32, 24],
    "position": ["0 m", "-50 m", "100 m"],
    "look_at": ["0 m", "0 m", "0 m"],
}


def box_obj(low, high):
    corners = [[(low, high)[bit >> axis & 1][axis] for axis in range(3)] for bit in range(8)]
    faces = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"]
    return "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join(f"f {face}\n" for face in faces)


def ascii_grid(values, corner=(-8, -8), cell=4, nodata=None):
    rows = "\n".join(" ".join(str(v) for v in row) for row in values)
    text = f"ncols {len(values[0])}\nnrows {len(values)}\nxllcorner {corner[0]}\nyllcorner {corner[1]}\ncellsize {cell}\n"
    return text + (f"NODATA_value {nodata}\n" if nodata is not None else "") + rows + "\n"


WARM = [[295, 296, 297, 298]] * 4


def changed(path, value):
    """A copy of the good document with one value put, or taken out where `value` is None. "[+]" appends."""
    return put(copy.deepcopy(GOOD), path, value)


def put(document, path, value):
    keys = re.findall(r"[^.\[\]]+|\[\+\]|\[\d+\]", path)
    node = document
    for key in keys[:-1]:
        key = int(key[1:-1]) if key.startswith("[") else key
        if isinstance(node, dict):
            node = node.setdefault(key, {})
        else:
            node = node[key]
    last = keys[-1]
    if last == "[+]":
        node.append(value)
    elif value is None:
        del node[int(last[1:-1]) if last.startswith("[") else last]
    elif last.startswith("["):
        node[int(last[1:-1])] = value
    else:
        node[last] = value
    return document


def several(*changes):
    document = copy.deepcopy(GOOD)
    for path, value in changes:
        put(document, path, value)
    return document


CAMERA = "sensor.camera"
OBJECTS = "scene.objects"
MATERIALS = "scene.materials"
ERROR, WARNING = "error", "warning"
