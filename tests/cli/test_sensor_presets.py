"""`ifov sensors` and `"preset"`: instruments by name, their figures against measured responses."""

import csv
import functools
import json
import os
import pathlib
import re
import unittest

from program import Folder, run
from test_detector import changed, mean_radiance

TRUTH = pathlib.Path(os.environ.get("IFOV_TRUTH", pathlib.Path(__file__).resolve().parents[3] / "shared/truth")) / "sensors"


@functools.cache
def names():
    rows = run("sensors").stdout.split("\n\n")[0].splitlines()[1:]
    return [re.split("  +", row)[0] for row in rows]


@functools.cache
def printed(name):
    done = run("sensors", name)
    assert (done.returncode, done.stderr) == (0, ""), done
    return done.stdout


def document(name):
    return json.loads("\n".join(line for line in printed(name).splitlines() if not line.startswith("//")))


def bands(name):
    """(name, centre, width) of each, um; those of series have no name."""
    told = []
    for channel in document(name)["sensor"]["channels"]:
        um = lambda record, *keys: (float(record[key].split()[0]) for key in keys)
        if "series" in channel:
            record = channel["series"]["gaussian"]
            first, last, width = um(record, "from", "to", "fwhm")
            count = record["count"]
            told += [("", first + (last - first) * k / (count - 1), width) for k in range(count)]
        elif "top_hat" in channel:
            first, last = um(channel["top_hat"], "from", "to")
            told.append((channel["name"], 0.5 * (first + last), last - first))
        else:
            told.append((channel["name"], *um(channel["gaussian"], "center", "fwhm")))
    return told


class Presets(unittest.TestCase):
    def test_all_that_was_asked_for(self):
        for name in ("Landsat 8 OLI", "Landsat 8 TIRS", "Landsat 9 OLI-2", "Landsat 9 TIRS-2", "Sentinel-2 MSI", "Sentinel-3 OLCI", "Sentinel-3 SLSTR", "MODIS",
                     "VIIRS", "ASTER", "ECOSTRESS", "WorldView-3", "PlanetScope SuperDove", "EnMAP", "PRISMA", "EMIT", "DESIS", "AVIRIS-NG", "HyTES",
                     "microbolometer", "cooled MWIR camera", "dslr"):
            self.assertIn('"channels": [', printed(name))

    def test_the_listing_is_a_table(self):
        rows = run("sensors").stdout.split("\n\n")[0].splitlines()
        self.assertRegex(rows[0], "^instrument +bands +um +noise +pixel")
        self.assertEqual(len(names()), len(rows) - 1)
        for row, name in zip(rows[1:], names()):
            self.assertLessEqual(len(row), 120)
            count, first, last = re.match(re.escape(name) + r" +(\d+) +([\d.]+) to ([\d.]+) +\w", row).groups()
            all_bands = bands(name)
            self.assertEqual(int(count), len(all_bands))
            self.assertAlmostEqual(float(first), min(centre - width / 2 for _, centre, width in all_bands), delta=1e-3 * float(first))
            self.assertAlmostEqual(float(last), max(centre + width / 2 for _, centre, width in all_bands), delta=1e-3 * float(last))

    def test_every_preset_has_dated_sources_and_loads(self):
        """What is printed of it is what a document takes by its name, and `ifov check` has nothing to say of it."""
        for name in names():
            with self.subTest(name):
                comments = " ".join(line[3:] for line in printed(name).splitlines() if line.startswith("// "))
                self.assertRegex(comments, r"^" + re.escape(name) + r": .+ - .*(19|20)\d\d.*Licence: ")
                written = document(name)
                named = written | {"sensor": {"preset": name.upper(), "camera": written["sensor"]["camera"]}}
                with Folder(written=printed(name), named=json.dumps(named)) as folder:
                    told = [run("sensor", f"{which}.json", cwd=folder) for which in ("written", "named")]
                    checked = run("check", "written.json", cwd=folder)
                self.assertEqual([(one.returncode, one.stderr) for one in (*told, checked)], [(0, "")] * 3)
                self.assertEqual(told[0].stdout, told[1].stdout)

    def test_what_a_document_says_counts_before(self):
        written = document("Nikon D700")
        camera = written["sensor"]["camera"]

        def told(**own):
            sensor = {"preset": "Nikon D700", "camera": camera, **own}
            with Folder(scene=json.dumps(written | {"sensor": sensor})) as folder:
                done = run("sensor", "scene.json", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout, float(re.search("electrons +([0-9.e+]+)", done.stdout)[1])

        plain, electrons = told()
        self.assertIn("mosaic (red, green), (green, blue)", plain)
        longer, more = told(detector={"integration_time": "2 ms"})
        self.assertAlmostEqual(more / electrons, 2, delta=2e-3)
        self.assertIn("SNR", longer)
        # An f-number of its own, in other words: an aperture and the camera's focal length.
        wider, most = told(optics={"aperture": "12.5 mm", "throughput": 0.5})
        self.assertIn("f/4\n", wider)
        self.assertAlmostEqual(most / electrons, 0.5 * (8 / 4) ** 2, delta=5e-3)
        self.assertIn("mosaic (red, red)", told(mosaic=[["red", "red"]])[0])

    def test_noise_of_modis(self):
        """Required NEdT at other temperatures than 300 K is a radiance: of band 33, 0.25 K at 260 K."""
        scene = changed(sensor__optics=None, sensor__detector=None, sensor__channels=None)
        scene["sensor"]["preset"] = "MODIS"
        with Folder(scene=json.dumps(scene)) as folder:
            out = run("sensor", "scene.json", cwd=folder).stdout
        nedl = float(re.search(r"^33: .*?NEdL +([0-9.e-]+)", out, re.M | re.S).group(1))
        slope = mean_radiance(13.185, 13.485, 260.5) - mean_radiance(13.185, 13.485, 259.5)
        self.assertAlmostEqual(nedl / (0.25 * slope), 1, delta=1e-3)
        self.assertAlmostEqual(float(re.search(r"^1: .*?NEdL +([0-9.e-]+)", out, re.M | re.S).group(1)), 21.8 / 128, delta=1e-4)

    def test_noise_of_a_spectrometer(self):
        """Of EMIT at 1647.73 nm a sqrt(b + L) of the model that is cited, at reflectance 0.3 under the Sun (some 229 W m-2 um-1 there) at 45 deg."""
        with Folder(scene=printed("EMIT")) as folder:
            out = run("sensor", "scene.json", cwd=folder).stdout
        radiance = 0.3 * 0.70711 * 229 / 3.14159 / 10
        nedl = float(re.search(r"^1647\.\d+ nm: .*?NEdL +([0-9.e-]+)", out, re.M | re.S)[1])
        self.assertAlmostEqual(nedl / (10 * 0.00202568 * (0.36445974 + radiance) ** 0.5), 1, delta=0.01)

    def test_a_microbolometer_follows_slowly(self):
        with Folder(scene=printed("640 x 512 microbolometer")) as folder:
            out = run("sensor", "scene.json", cwd=folder).stdout
        self.assertIn("640 x 512 pixels", out)
        self.assertIn("NEdT         0.05 K at 300 K", out)
        self.assertIn("93.8 % of a step", out)  # 1 - exp(-33.33 / 12)

    def test_mistakes(self):
        done = run("sensors", "Landsat 8 TIR")
        self.assertEqual(done.returncode, 1)
        self.assertIn("there is no preset 'Landsat 8 TIR'; did you mean 'Landsat 8 TIRS'? (", done.stderr)
        self.assertIn("did you mean 'Sentinel-2 MSI', 'Sentinel-3 OLCI' or 'Sentinel-3 SLSTR'?", run("sensors", "sentinel").stderr)
        self.assertIn("did you mean 'Sentinel-2 MSI', 'Sentinel-3 OLCI' or 'Sentinel-3 SLSTR'?", run("sensors", "sentinle").stderr)
        self.assertIn("did you mean 'EMIT'?", run("sensors", "EMTI").stderr)
        self.assertIn("'HyTES'", run("sensors", "nothing of the kind").stderr)
        plain = changed(sensor__optics=None, sensor__detector=None)
        plain["sensor"]["preset"] = "MODIS"
        detector = changed(sensor__channels=None)
        detector["sensor"]["preset"] = "Landsat 8 TIRS"
        pitch = document("DSLR")
        pitch["sensor"] = {"preset": "DSLR", "camera": {"frame": pitch["sensor"]["camera"]["frame"] | {"pitch": "6 um"}}}
        misspelt = document("DSLR")
        misspelt["sensor"] = {"preset": "DSRL", "camera": misspelt["sensor"]["camera"]}
        with Folder(**{key: json.dumps(value, indent=1)
                       for key, value in (("both", plain), ("detector", detector), ("pitch", pitch), ("misspelt", misspelt))}) as folder:
            said = {key: run("check", f"{key}.json", cwd=folder).stderr for key in ("both", "detector", "pitch", "misspelt")}
        self.assertRegex(said["both"], r"^both\.json:\d+:\d+: .*'channels'")
        self.assertIn("channel '10' states its noise by 'noise_temperature', and its noise also follows from the 'detector'", said["detector"])
        self.assertRegex(said["pitch"], r'^pitch\.json:\d+:\d+: detector.pitch is 8\.459 um, and the camera\'s pitch 6 um(.|\n)*"preset": "DSLR"')
        self.assertRegex(said["misspelt"], r"^misspelt\.json:\d+:\d+: there is no preset 'DSRL'; did you mean 'DSLR'\?")


def responses(file):
    """Measured ones by the name of their block, of an agency's file as ACOLITE has it: rows of um and response."""
    found, rows = {}, None
    for line in (TRUTH / "rsr-acolite" / file).read_text(encoding="latin-1").splitlines():
        if not line.strip() or line[0] in ";#":
            heading = re.match(r"^[;#]+\s*(?:.*\s)?B(?:AND|and)\s+(\S+)", line)
            if heading:
                rows = found.setdefault(heading[1], [])
        elif rows is not None:
            um, response = map(float, line.replace(",", " ").split()[:2])
            rows.append((um * (1e-3 if um > 100 else 1), response))
    return found


def middle_and_width(rows):
    """Of where the response is half of its highest for the first and for the last time."""
    half = 0.5 * max(response for _, response in rows)
    at = [a + (half - low) / (high - low) * (b - a) for (a, low), (b, high) in zip(rows, rows[1:]) if (low - half) * (high - half) < 0]
    return 0.5 * (at[0] + at[-1]), at[-1] - at[0]


#: What an instrument's bands are called in its file, where not by their own names.
ALIKE = {"Sentinel-2 MSI": lambda name: name.lstrip("B"), "Sentinel-3 OLCI": lambda name: f"Oa{int(name[2:]):02}",
         "VIIRS": lambda name: f"{name[0]}{int(name[1:]):02}" if name != "DNB" else name,
         # Numbered by wavelength there, 1 to 16.
         "MODIS": lambda name: str("8 9 3 10 11 12 4 1 13 14 15 2 16 5 6 7".split().index(name) + 1) if int(name) < 17 else "",
         "WorldView-3": lambda name: str("COASTAL BLUE GREEN YELLOW RED REDEDGE NIR1 NIR2 SWIR1 SWIR2 SWIR3 SWIR4 SWIR5 SWIR6 SWIR7 SWIR8 PAN".split().index(name) + 1),
         "PlanetScope SuperDove": lambda name: str("Coastal_Blue Blue Green_I Green_II Yellow Red RedEdge NIR".split().index(name) + 1)}
#: Bands that were built otherwise than they are told: where their middle is, in widths, and how many times as wide they are.
BUILT_OTHERWISE = {("VIIRS", "M12"): (-0.31, 1.07), ("Sentinel-3 OLCI", "Oa21"): (-0.18, 0.68), ("WorldView-3", "NIR2"): (-0.25, 0.48),
                   ("Landsat 9 TIRS-2", "10"): (-0.12, 1.27), ("MODIS", "6"): (-0.50, 1.15), ("MODIS", "7"): (-0.34, 1.06), ("MODIS", "12"): (-0.40, 1.03)}


def misfits(all_bands, measured, alike=lambda name: name):
    """Of bands that lie further than a fifth of their width from the measured response, or are not within a fifth as wide; and how many were compared."""
    far, seen = {}, 0
    for name, centre, width in all_bands:
        rows = measured.get(alike(name))
        if rows is None:
            continue
        seen += 1
        middle, wide = middle_and_width(rows)
        if abs(middle - centre) > 0.2 * width or abs(wide / width - 1) > 0.2:
            far[name] = ((middle - centre) / width, wide / width)
    return far, seen


@unittest.skipUnless((TRUTH / "rsr-acolite").exists(), "no measured responses under shared/truth/sensors")
class AgainstMeasuredResponses(unittest.TestCase):
    FILES = {"Landsat 8 OLI": ("L8_OLI", 9), "Landsat 8 TIRS": ("L8_TIRS", 2), "Landsat 9 OLI-2": ("L9_OLI", 9), "Landsat 9 TIRS-2": ("L9_TIRS", 2),
             "Sentinel-2 MSI": ("S2A_MSI_V4", 13), "Sentinel-3 OLCI": ("S3A_OLCI", 21), "MODIS": ("Terra_MODIS", 16), "ASTER": ("TERRA_ASTER_TIR", 5),
             "VIIRS": ("SUOMI-NPP_VIIRS_TIR", 7), "ECOSTRESS": ("ISS_ECOSTRESS", 5), "WorldView-3": ("WorldView3", 17), "PlanetScope SuperDove": ("PlanetScope_SD8", 8)}

    def test_bands(self):
        for name, (file, count) in self.FILES.items():
            with self.subTest(name):
                measured = responses(f"{file}.txt")
                far, seen = misfits(bands(name), measured, ALIKE.get(name, str))
                self.assertEqual(seen, count)
                otherwise = {band: figures for (of, band), figures in BUILT_OTHERWISE.items() if of == name}
                self.assertEqual(far.keys(), otherwise.keys(), far)
                for band, figures in otherwise.items():
                    for is_so, told in zip(far[band], figures):
                        self.assertAlmostEqual(is_so, told, delta=0.01)

    def test_a_fault_is_seen(self):
        """A centre that is off by a quarter of a width, an edge by as much, two bands exchanged."""
        measured = responses("ISS_ECOSTRESS.txt")
        sound = bands("ECOSTRESS")
        self.assertEqual(misfits(sound, measured), ({}, 5))
        for k, (name, centre, width) in enumerate(sound):
            others = sound[:k] + sound[k + 1:]
            for fault in ((name, centre + 0.25 * width, width), (name, centre, 1.3 * width), (name, centre, 0.75 * width)):
                self.assertEqual(list(misfits([*others, fault], measured)[0]), [name])
        exchanged = [(a[0], *b[1:]) for a, b in zip(sound, sound[1:] + sound[:1])]
        self.assertEqual(len(misfits(exchanged, measured)[0]), 5)

    def test_expected_bands(self):
        """The middle and the width that the agency's numbers have, worked out elsewhere."""
        rows = list(csv.DictReader((TRUTH / "expected_bands.csv").open()))
        for row in rows:
            if row["sensor"] not in ("L8_OLI", "S2A_MSI_V4", "ISS_ECOSTRESS"):
                continue
            middle, width = middle_and_width(responses(row["sensor"] + ".txt")[row["band"]])
            self.assertAlmostEqual(middle, float(row["centroid_um"]), delta=0.12 * width, msg=row)
            self.assertAlmostEqual(width / float(row["fwhm_um"]), 1, delta=1e-2, msg=row)


def columns(file):
    return [(float(row["wavelength"]) * 1e-3, float(row["fwhm"]) * 1e-3) for row in csv.DictReader((TRUTH / "channels" / file).open())]


def off_um(told, measured):
    """The furthest that a channel's centre is from that of its number."""
    if len(told) != len(measured):
        return float("inf")
    return max(abs(a - b) for a, b in zip(sorted(told), sorted(measured)))


def median(values):
    return sorted(values)[len(values) // 2]


@unittest.skipUnless((TRUTH / "channels").exists(), "no channels under shared/truth/sensors")
class AgainstMeasuredChannels(unittest.TestCase):
    def test_spectrometers(self):
        """Channel by channel: centres within so many nm, widths by their median."""
        for name, file, within_nm, share in (("EMIT", "emit.csv", 0.6, 0.02), ("EnMAP", "enmap.csv", 0.6, 0.05), ("DESIS", "desis.csv", 2.0, 0.05)):
            with self.subTest(name):
                centres, measured = [centre for _, centre, _ in bands(name)], columns(file)
                self.assertLess(off_um(centres, [um for um, _ in measured]), 1e-3 * within_nm)
                # A shift of a fifth of a channel, and one that is left out, are seen where steps are as published.
                if name != "DESIS":
                    self.assertGreater(off_um([centre + 1.2e-3 for centre in centres], [um for um, _ in measured]), 1e-3 * within_nm)
                self.assertGreater(off_um(centres[1:], [um for um, _ in measured]), 1e-3 * within_nm)
                wide = median([width for _, _, width in bands(name)])
                self.assertAlmostEqual(median([width for _, width in measured]) / wide, 1, delta=share if name != "EnMAP" else 0.2)

    def test_prisma_is_counted_otherwise(self):
        """Its products have 230 channels, and the table 234 of another calibration: as many in each 0.2 um, within two, and as wide."""
        told, measured = bands("PRISMA"), columns("prisma.csv")
        count = lambda values, first: sum(first <= um < first + 0.2 for um in values)
        for step in range(10):
            first = 0.42 + 0.2 * step
            self.assertLessEqual(abs(count([um for _, um, _ in told], first) - count([um for um, _ in measured], first)), 2 if step != 2 else 5, first)
        self.assertAlmostEqual(median([width for _, width in measured]) / 0.012, 1, delta=0.1)

    def test_aviris_ng(self):
        """Nominal steps of 5 nm: 425 channels of 5.008 nm lie within 3.2 nm, and are a fifth wider."""
        rows = [line.split() for line in (TRUTH / "channels/isofit_test_wavelengths.txt").read_text().splitlines()]
        told = [centre for _, centre, _ in bands("AVIRIS-NG")]
        self.assertLess(max(min(abs(float(row[1]) - centre) for centre in told) for row in rows), 3.2e-3)
        self.assertAlmostEqual(median([float(row[2]) for row in rows]) / 0.005, 1.15, delta=0.06)


if __name__ == "__main__":
    unittest.main()
