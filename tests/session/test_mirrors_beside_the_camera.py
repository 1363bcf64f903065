"""Hot things and mirrors about a camera that stands among them: planes of mirrors that end for it within a thing's image, or run through the thing."""

import array
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["IFOV_PROGRAM"]
SIDE = 8


def box(low, high, material, degrees=0.0):
    return {"box": {"low": [f"{k} m" for k in low], "high": [f"{k} m" for k in high]}, "material": material,
            "transform": {"rotate": {"angle": f"{degrees} deg"}}}


class MirrorsBesideTheCamera(unittest.TestCase):
    def render(self, objects, sampling, seed):
        document = {"ifov": 1, "seed": seed,
                    "scene": {"materials": {"ground": {"emissivity": 0.9, "temperature": "279 K"}, "hot": {"emissivity": 0.6, "temperature": "420 K"},
                                            "mirror": {"emissivity": 0.05, "temperature": "281 K", "scattering": "mirror"}},
                              "objects": [{"plane": {}, "material": "ground"}, *objects]},
                    "light": {"sky": {"temperature": "251 K"}},
                    "sensor": {"camera": {"frame": {"focal_length": "50 mm", "pitch": "4575 um", "pixels": [SIDE, SIDE],
                                                    "position": ["4.6 m", "-3 m", "12.5 m"], "look_at": ["0 m", "0 m", "0 m"]}},
                               "channels": [{"name": "tir", "top_hat": {"from": "9.9 um", "to": "10.1 um"}}]},
                    "sampling": sampling, "output": {"formats": ["envi"]}}
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "scene.json").write_text(json.dumps(document))
            # The search for images of hot things never ended where the plane's end ran through them.
            done = subprocess.run([PROGRAM, "render", "scene.json", "-o", "out", "-q"], cwd=folder, capture_output=True, text=True, check=False, timeout=120)
            self.assertIn(done.returncode, (0, 5, 6), done.stderr)
            cubes = {}
            for name in ("radiance", "half_width"):
                file = Path(folder) / "out" / f"image_{name}.img"
                if file.exists():
                    cubes[name] = array.array("f", file.read_bytes())
            return cubes

    def test_images_are_found(self):
        scenes = ([box((-2.2, -1.9, 0.0), (-2.0, -1.7, 4.75), "mirror", 56.4), box((-0.9, -6.2, 0.0), (0.2, -3.5, 5.7), "hot", 83.1)],
                  [box((-2.2, -1.9, 0.0), (-2.0, -1.7, 4.75), "mirror"), box((-0.9, -6.2, 0.0), (0.2, -3.5, 5.7), "hot", 83.1)])
        for scene in scenes:
            truth = self.render(scene, {"accuracy": {"error": "0.3 %", "of": "image"}}, 7)["radiance"]
            for seed in (1, 2):
                cubes = self.render(scene, {"accuracy": {"error": "2 %"}}, seed)
                off = [abs(a - b) / w for a, b, w in zip(cubes["radiance"], truth, cubes["half_width"])]
                self.assertGreater(sum(z <= 1.2 for z in off) / len(off), 0.9)
                self.assertLess(max(off), 4.0)


if __name__ == "__main__":
    unittest.main()
