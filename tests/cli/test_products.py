"""Which products a run leaves, under which name, and what they take of the disk."""

import json
import re
import unittest

from program import DOME, Folder, products, run

ORIGIN = '"origin": {"latitude": "49.4 deg", "longitude": "8.7 deg"},\n    "materials": {'
FRAME = ('"camera": {"frame": {"pixels": [40, 30], "focal_length": "20 mm", "pitch": "0.1 mm", "position": ["2 m", "1 m", "9 m"],'
         ' "look_at": ["0 m", "0 m", "0 m"]}}')
ORTHOGRAPHIC = '"camera": {"orthographic": {"gsd": "1 m", "pixels": [3, 3]}}'
TRUTH = ["range", "normal", "slope", "gsd", "time", "sun_angles", "shadow", "sky_view", "material_class", "dominant_material", "material_count",
         "object_class", "instance"]
PARTS = [word + end for word in ("emitted_radiance", "sun_radiance", "sky_radiance", "scene_radiance", "path_radiance", "transmittance")
         for end in ("", "_standard_error")]
LARGE = {"gsd": "5 cm", "pixels": [64, 48]}


def cubes(folder):
    return sorted(file.name for file in folder.iterdir() if file.suffix == ".img")


def with_output(text, **output):
    return text.replace('"output": {"formats": ["envi", "png"]}', '"output": ' + json.dumps(output))


class Lists(unittest.TestCase):
    def test_the_document_names_cubes_and_files(self):
        scene = with_output(DOME, name="flight_7", formats=["envi", "netcdf"], products=["standard_error"])
        with Folder(scene=scene) as folder:
            done = run("render", "scene.json", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(sorted(file.name for file in (folder / "scene.out").iterdir()),
                             ["flight_7_radiance.img", "flight_7_radiance.img.hdr", "flight_7_radiance.nc", "flight_7_radiance.qml", "flight_7_run.json",
                              "flight_7_standard_error.img", "flight_7_standard_error.img.hdr"])
            self.assertIn("complete", run("status", "scene.out", cwd=folder).stdout)
            self.assertIn("flight_7_run.json", run("info", "scene.out", cwd=folder).stdout)

    def test_what_is_written_by_default_and_all(self):
        usual = ["abundance", "half_width", "quality", "quality_class", "radiance", "reasons", "samples"]
        with Folder(usual=DOME, frame=DOME.replace(ORTHOGRAPHIC, FRAME),
                    all=with_output(DOME, formats=["envi"], products=["all"])) as folder:
            for name, wanted in (("usual", usual), ("frame", sorted([*usual, "location"])),
                                 ("all", sorted([*usual, "standard_error", "abundance_half_width", "location", "true_location", "view_angles", "temperature", "radiance_per_nm", "radiance_per_nm_half_width", "band_radiance", "band_radiance_half_width", "photon_radiance", "photon_radiance_half_width", "pixel_temperature", "emissivity", "brightness_temperature", "brightness_temperature_half_width", *TRUTH, *PARTS]))):
                self.assertEqual(run("render", f"{name}.json", cwd=folder).returncode, 0)
                self.assertEqual(cubes(folder / f"{name}.out"), sorted(f"image_{cube}.img" for cube in wanted))

    def test_many_channels_take_little_more_than_twice_the_radiance(self):
        many = [{"name": f"c{k}", "monochromatic": {"at": f"{8 + 0.01 * k} um"}} for k in range(210)]
        scene = json.loads(re.sub("//.*", "", DOME))
        scene["sensor"] = {"camera": {"orthographic": LARGE}, "channels": many}
        scene["sampling"] = {"grid": {"elements": [2, 2]}}
        with Folder(scene=json.dumps(scene)) as folder:
            forecast = run("render", "scene.json", "--dry-run", cwd=folder)
            done = run("render", "scene.json", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            out = folder / "scene.out"
            radiance = (out / "image_radiance.img").stat().st_size
            whole = sum(file.stat().st_size for file in out.iterdir() if file.suffix == ".img")
            self.assertLess(whole, 2.2 * radiance)
            found = re.search(r"disk +([\d.]+) (\w+) while it works, ([\d.]+) (\w+) of products", forecast.stdout)
            self.assertIsNotNone(found, forecast.stdout + forecast.stderr)
            bytes_of = {"kB": 1e3, "MB": 1e6, "GB": 1e9}
            self.assertAlmostEqual(float(found[3]) * bytes_of[found[4]], whole, delta=0.03 * whole)
            self.assertLess(float(found[1]) * bytes_of[found[2]], 4.3 * radiance)


class Pieces(unittest.TestCase):
    """Places of pixels, and tiles without variances, are the same whoever wrote them."""

    def test_shares_and_threads_leave_the_same_bytes(self):
        scene = with_output(DOME.replace(ORTHOGRAPHIC, FRAME).replace('"materials": {', ORIGIN, 1).replace(
            '{"accuracy": {"error": "0.1 K", "channel": "B"}}', '{"accuracy": {"error": "0.1 K", "channel": "B"}, "tile": 8}'),
            formats=["envi", "geotiff", "netcdf"], products=["half_width", "quality", "location", "view_angles", *TRUTH])
        with Folder(scene=scene) as folder:
            self.assertEqual(run("render", "scene.json", "-j", 1, cwd=folder).returncode, 0)
            self.assertEqual(run("render", "scene.json", "-j", 2, "--output", "two", cwd=folder).returncode, 0)
            for share in (1, 2):
                self.assertEqual(run("render", "scene.json", "--tiles", f"{share}/2", cwd=folder).returncode, 0)
            done = run("merge", "scene.out.1-of-2", "scene.out.2-of-2", "--output", "merged", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            reference = products(folder / "scene.out")
            self.assertEqual(len(reference), 40)
            for other in ("two", "merged"):
                found = products(folder / other)
                for name, content in reference.items():
                    self.assertEqual(found[name], content, f"{other}/{name}")


if __name__ == "__main__":
    unittest.main()
