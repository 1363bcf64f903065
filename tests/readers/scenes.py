"""Documents whose products the readers' tests open, and what is in them."""

import array
import json
import pathlib
import subprocess

CHANNELS = [("blue", 0.48, 0.02), ("green", 0.56, 0.02), ("red", 0.66, 0.03), ("nir", 0.86, 0.04)]
THERMAL = [("B10", 10.9, 0.6)]
WIDTH, HEIGHT = 24, 16
EASTING, NORTHING = 477000.0, 5474000.0


def document(origin, camera, channels=CHANNELS, **more):
    map_origin = {"center": [f"{EASTING} m", f"{NORTHING} m"]} if "easting" in origin and "orthographic" in camera else {}
    camera = {model: {**(map_origin if model == "orthographic" else {}), **keys} for model, keys in camera.items()}
    at = (EASTING, NORTHING) if "easting" in origin else (0.0, 0.0)
    return {"ifov": 1, "time": "2024-06-21T10:30:00Z",
            "scene": {"origin": origin,
                      "materials": {"grass": {"reflectance": 0.1, "temperature": "20 degC"},
                                    "roof": {"reflectance": 0.4, "temperature": "40 degC"}},
                      "objects": [{"plane": {}, "material": "grass"},
                                  {"sphere": {"center": [f"{at[0] + 3} m", f"{at[1] + 2} m", "0 m"], "radius": "2 m"},
                                   "material": "roof"}]},
            "light": {"sun": {"point": {"zenith": "35 deg", "azimuth": "140 deg"}},
                      "sky": {"radiance": "30 W m-2 sr-1 um-1"}},
            "sensor": {"camera": camera,
                       "channels": [{"name": name, "gaussian": {"center": f"{um} um", "fwhm": f"{fwhm} um"}}
                                    for name, um, fwhm in channels]},
            "sampling": {"grid": {"elements": [2, 2]}, "max_depth": 1},
            "output": {"formats": ["envi", "geotiff", "netcdf", "png", "html"], "products": ["half_width", "location", "view_angles"], **more}}


def render(program, scene, folder):
    """The folder of its products."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scene.json").write_text(json.dumps(scene))
    done = subprocess.run([program, "render", folder / "scene.json", "--output", folder / "out"], capture_output=True,
                          text=True, timeout=120, check=False)
    if done.returncode not in (0, 5, 6):
        raise AssertionError(done.stdout + done.stderr)
    return folder / "out"


def plane(file, bands, code="f", width=WIDTH, height=HEIGHT):
    """Values of an ENVI cube as [band][line][sample], straight from its bytes."""
    values = array.array(code, file.read_bytes())
    return [[[values[(y * bands + b) * width + x] for x in range(width)] for y in range(height)] for b in range(bands)]
