"""Gas models: made of spectra by `ifov gases`, used by `ifov atmosphere` and documents, and what is said where they do not fit."""

import math
import pathlib
import re
import unittest

from program import Folder, run

SCENE = """{
  "ifov": 1,
  "scene": {
    "materials": {"soil": {"reflectance": 0.2, "temperature": "300 K"}},
    "objects": [{"plane": {}, "material": "soil"}]
  },
  "light": {"sun": {"disc": {"zenith": "30 deg", "azimuth": "150 deg"}}},
  "atmosphere": {"profile": "mid-latitude summer", "aerosol": {"type": "none"}%s},
  "sensor": {
    "camera": {"orthographic": {"gsd": "1 m", "pixels": [4, 4]}},
    "channels": [
      {"name": "line", "top_hat": {"from": "2.3232 um", "to": "2.3254 um"}},
      {"name": "beside", "top_hat": {"from": "2.3256 um", "to": "2.3272 um"}}%s
    ]
  },
  "sampling": {"single": {}}
}
"""
USED = ', "gas_model": "m.gases"'
PRESSURES, TEMPERATURES = (1, 3, 9, 27, 80, 200, 450, 1080), (180, 215, 250, 285, 320)


def spectra(lines, first=4296.0, last=4306.0, step=0.01, pressures=PRESSURES, gap=(0.0, 0.0)):
    """Lorentz lines (centre, strength, width at 1013.25 hPa)."""
    rows = ["cm-1," + ",".join(f"{p} hPa {t} K" for p in pressures for t in TEMPERATURES)]
    for k in range(round((last - first) / step) + 1):
        nu = first + k * step
        if gap[0] < nu < gap[1]:
            continue
        row = [f"{nu:.3f}"]
        for p in pressures:
            for t in TEMPERATURES:
                sigma = 0.0
                for centre, strength, width in lines:
                    a = max(0.005, width * p / 1013.25 * (296 / t) ** 0.7)
                    sigma += strength * a / math.pi / ((nu - centre) ** 2 + a * a)
                row.append(f"{sigma:.4e}")
        rows.append(",".join(row))
    return "\n".join(rows) + "\n"


METHANE = spectra([(4301.5, 2e-20, 0.06), (4302.8, 1e-20, 0.05)])


class Folded(unittest.TestCase):
    def made(self, folder, *arguments):
        (folder / "ch4.csv").write_text(METHANE)
        done = run("gases", "CH4=ch4.csv", "-o", "m.gases", *arguments, cwd=folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout


def columns(text, channel):
    """The first row of numbers of a channel."""
    line = next(line for line in text.splitlines() if line.split()[:1] == [channel])
    return [float(word) if word != "-" else None for word in line.split()[1:]]


def model_error(text):
    """The largest of all channels, percent."""
    return float(re.search(r"error of the model of the air: \S+ to (\S+) % ", text).group(1))


class Made(Folded):
    def test_what_is_said_and_written(self):
        with Folder() as folder:
            said = self.made(folder, "--source", "two lines")
            found = re.fullmatch(r"m\.gases  \(gas model: 10 bins of 1 cm-1 from 4296 to 4306 cm-1, ([\d.]+) terms each\)\n"
                                 r"Transmittance along paths through six model atmospheres, terms less spectra: rms (\S+), largest "
                                 r"(\S+) \(at \S+ cm-1\), mean over all bins (\S+)\.\n"
                                 r"Interpolation between the states of the spectra may add \S+ at most; bins have both in their error\.\n", said)
            self.assertIsNotNone(found, said)
            terms, rms, largest, mean = map(float, found.groups())
            self.assertTrue(1 <= terms <= 16 and 0 < rms <= 1e-3 and rms < largest < 2e-3 and mean < largest, found.groups())
            text = (folder / "m.gases").read_text()
            self.assertTrue(text.startswith("ifov gas model 1\n"))
            self.assertIn("\nsource two lines\nbins 4296 1 10\n", text)
            # The same bytes again, by one thread.
            self.made(folder, "--source", "two lines", "-j", "1")
            self.assertEqual((folder / "m.gases").read_text(), text)

    def test_options(self):
        with Folder() as folder:
            self.assertIn("3 bins of 2 cm-1 from 4298 to 4304 cm-1, 1.0 terms", self.made(folder, "--bin", "2", "--range", "4298,4304", "--terms", "1"))
            (folder / "h2o.csv").write_text(METHANE)
            done = run("gases", "CH4=ch4.csv", "H2O=h2o.csv", "-o", "two.gases", "--self-broadening", "H2O=4.9", "--continuum", "H2O",
                       "--depth-error", "H2O=0.03", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertRegex(done.stdout, r"The gases share their terms; overlapping at random they would be off by \S+ \(rms\)\.\n")
            self.assertIn("\ngas CH4\ngas H2O self_broadening 4.9 depth_error 0.03 continuum\n", (folder / "two.gases").read_text())

    def test_mistakes(self):
        with Folder() as folder:
            (folder / "ch4.csv").write_text(METHANE)
            (folder / "other.csv").write_text(spectra([], 4296.0, 4306.0, 0.02))
            (folder / "gap.csv").write_text(spectra([], gap=(4299.5, 4303.0)))
            (folder / "nm.csv").write_text(METHANE.replace("cm-1,", "nm,", 1))
            for arguments, said in (
                    (["ch4.csv"], "ifov: GAS=SPECTRA is 'ch4.csv', expected such as CH4=methane.csv"),
                    (["HCl=ch4.csv"], "unknown gas 'HCl'; expected 'H2O'"),
                    (["CH4=ch4.csv", "ch4=ch4.csv"], "the gas ch4 is there twice"),
                    (["CH4=ch4.csv", "H2O=other.csv"], "ch4.csv and other.csv have other wavenumbers: gases of one model share them"),
                    (["CH4=ch4.csv", "--range", "4290,4300"], "bins from 4290 to 4300 cm-1 were asked for; the spectra reach from 4296 to 4306 cm-1"),
                    (["CH4=ch4.csv", "--bin", "0.1"], "the spectra have 10 points in the bin from 4296 to 4296.1 cm-1; expected 20 at least"),
                    (["CH4=gap.csv"], "the spectra have 0 points in the bin from 4300 to 4301 cm-1; expected 20 at least"),
                    (["CH4=nm.csv"], "nm.csv:1:1: found 'nm'; expected 'cm-1': the first column holds wavenumbers"),
                    (["CH4=ch4.csv", "--terms", "0"], "0 terms were asked for; expected 1 to 64"),
                    (["CH4=ch4.csv", "--depth-error", "H2O=0.1"], "ifov: --depth-error names 'H2O', and no spectra are given of it"),
                    (["CH4=ch4.csv", "--depth-error", "CH4=3"], "the depth of CH4 is said to be off by 3 of itself; expected 0 to 1"),
                    (["CH4=ch4.csv", "--self-broadening", "H2O=5"], "ifov: --self-broadening names 'H2O', and no spectra are given of it")):
                with self.subTest(arguments):
                    done = run("gases", *arguments, "-o", "m.gases", cwd=folder)
                    self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
                    self.assertIn(said, done.stderr)
                    self.assertFalse((folder / "m.gases").exists())
            done = run("gases", "CH4=ch4.csv", "-o", "./ch4.csv", cwd=folder)
            self.assertEqual((done.returncode, done.stderr),
                             (1, "./ch4.csv is to be written, and holds the spectra of CH4; expected another file\n"))
            self.assertEqual((folder / "ch4.csv").read_text(), METHANE)
            done = run("gases", "CH4=ch4.csv", "-o", "none/m.gases", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (2, "ifov: none/m.gases cannot be written: there is no folder none\n"))
            done = run("gases", "CH4=none.csv", "-o", "m.gases", cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (2, "ifov: cannot read 'none.csv': no such file\n"))


    def test_states_far_apart_are_warned_of(self):
        with Folder() as folder:
            (folder / "far.csv").write_text(spectra([(4301.5, 2e-20, 0.06)], pressures=(1, 20, 60, 180, 540)))
            done = run("gases", "--self-broadening", "CH4=1.3", "CH4=far.csv", "-o", "m.gases", "--terms", "1", cwd=folder)
            self.assertEqual(done.returncode, 6)
            self.assertIn("from 1 to 20 hPa cross sections are interpolated, which the errors of the terms do not hold; take pressures a factor of 3 "
                          "apart at most", done.stderr)
            self.assertIn("the spectra are of 1 to 540 hPa; air beyond that has the nearest of these", done.stderr)
            self.assertRegex(done.stdout, r"\n[1-9] of the bins are off by more than 0.001 somewhere with 1 terms: --terms lets them have more.\n")


class Used(Folded):
    def test_lines_that_bands_smooth_over_are_seen(self):
        with Folder(plain=SCENE % ("", ""), own=SCENE % (USED, "")) as folder:
            self.made(folder, "--source", "two lines")
            bands, terms = run("atmosphere", "plain.json", cwd=folder), run("atmosphere", "own.json", cwd=folder)
            self.assertEqual(terms.returncode, 0, terms.stderr)
            # The bands smooth both channels alike; of the lines one lies in the first channel alone.
            self.assertLess(abs(columns(bands.stdout, "line")[2] - columns(bands.stdout, "beside")[2]), 0.1)
            self.assertIn("channels narrower than the 20 cm-1", bands.stderr)
            self.assertEqual(terms.stderr, "")
            self.assertIn("Gas model: m.gases from 2.3223 to 2.3277 um (4296 to 4306 cm-1), CH4, in bins of 1 cm-1; all channels are within.\n"
                          "Its source: two lines.\n", terms.stdout)
            by_option = run("atmosphere", "plain.json", "--gases", "m.gases", cwd=folder)
            self.assertEqual(by_option.stdout, terms.stdout)

    def test_a_spectrum_has_the_bins(self):
        with Folder(own=SCENE % (USED, "")) as folder:
            self.made(folder)
            done = run("atmosphere", "own.json", "--csv", "fine.csv", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("10 steps of 1 cm-1", done.stderr)

    def test_renders_and_goes_on_the_same(self):
        with Folder(own=SCENE % (USED + ', "interval": "numerical"', ""), unsaid=(SCENE % (USED, "")).replace('"single": {}', '"accuracy": {"error": "50 %"}')) as folder:
            self.made(folder)
            for threads in ("1", "2"):
                done = run("render", "own.json", "-q", "-j", threads, "-o", "out" + threads, cwd=folder)
                self.assertEqual(done.returncode, 0, done.stderr)
            one, two = ((folder / f"out{k}" / "image_radiance.img") for k in "12")
            self.assertEqual(one.read_bytes(), two.read_bytes())
            said = run("check", "own.json", cwd=folder)
            self.assertEqual(said.returncode, 0, said.stderr)
            self.assertIn("m.gases", said.stdout)
            said = run("check", "unsaid.json", cwd=folder)
            self.assertEqual(said.returncode, 6, said.stderr)
            self.assertIn("the gas model does not say what its spectra are off by ('ifov gases --depth-error')", said.stderr)
            run("render", "unsaid.json", "-q", "-o", "out", cwd=folder)
            header = (folder / "out" / "image_half_width.img.hdr").read_text()
            self.assertIn("and of its model, which takes spectra behind the gas model for as wrong as the built-in bands", header)
            bands = model_error(said.stdout)
            self.made(folder, "--depth-error", "CH4=0.02")
            said = run("check", "unsaid.json", cwd=folder)
            self.assertNotIn("gas model", said.stderr)
            self.assertIn("the error of the model of the air has what it says of its spectra", said.stdout)
            self.assertLess(model_error(said.stdout), 0.8 * bands)
            run("render", "unsaid.json", "-q", "-o", "known", cwd=folder)
            self.assertNotIn("gas model", (folder / "known" / "image_half_width.img.hdr").read_text())

    def test_clouds_do_not_count_as_an_error_of_the_terms(self):
        """What comes straight through a cloud is next to nothing, and an error of transmittance was told as a share of that: 100 %."""
        cloud = ', "clouds": [{"kind": "water", "base": "1.5 km", "top": "2 km", "optical_depth": 8}], "interval": "numerical"'
        with Folder(clear=SCENE % (USED, ""), cloudy=SCENE % (USED + cloud, "")) as folder:
            self.made(folder)
            clear, cloudy = (float(re.search(r"numerical error of the air: \S+ to (\S+) % ", run("check", name, cwd=folder).stdout).group(1))
                             for name in ("clear.json", "cloudy.json"))
        self.assertLess(cloudy, 4 * clear)

    def test_other_channels_have_the_bands(self):
        outside = ', {"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "0.04 um"}}'
        with Folder(plain=SCENE % ("", outside), own=SCENE % (USED, outside)) as folder:
            self.made(folder)
            bands, terms = run("atmosphere", "plain.json", cwd=folder), run("atmosphere", "own.json", cwd=folder)
            self.assertEqual(columns(bands.stdout, "red"), columns(terms.stdout, "red"))
            self.assertIn("2 of 3 channels are within, the others have the built-in bands", terms.stdout)

    def refused(self, folder, *said, document="own.json", command=("atmosphere",)):
        done = run(*command, document, cwd=folder)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"own\.json:\d+:\d+: ")
        for text in said:
            self.assertIn(text, done.stderr)

    def test_what_does_not_fit_is_located(self):
        wide = ', {"name": "wide", "top_hat": {"from": "2.31 um", "to": "2.326 um"}}'
        with Folder(own=SCENE % (USED, wide)) as folder:
            self.made(folder)
            self.refused(folder, "own.json:13:", "the channel 'wide' reaches from 2.31 to 2.326 um, and the gas model from 2.3223 to 2.3277 um "
                         "(4296 to 4306 cm-1): expected a channel to lie within it, or outside, where the built-in bands hold")
        with Folder(own=SCENE % (USED, "")) as folder:
            self.refused(folder, "own.json:8:", "m.gases")
            self.made(folder, "--range", "4296,4297")
            self.refused(folder, "own.json:8:", "no channel lies within the gas model, which reaches from 2.3272 to 2.3277 um (4296 to 4297 cm-1)")
            self.made(folder)
            text = (folder / "m.gases").read_text()
            (folder / "m.gases").write_text(text.replace("model 1", "model 7"))
            self.refused(folder, "m.gases:1:16: found version '7'; this program reads version 1")
            weights = re.search(r"weights .*\n", text).group()
            (folder / "m.gases").write_text(text.replace(weights, "weights 0.5 0.6\n", 1))
            self.refused(folder, "sum to 1.1, 0.1 more than 1; expected 1 within 0.0001", command=("check",))
            thin = ("0.001", "0.003", "0.01", "0.03", "0.1", "1", "5", "7")
            mars = text.replace(f"pressures {' '.join(map(str, PRESSURES))}", f"pressures {' '.join(thin)}")
            for here, there in zip(PRESSURES, thin):
                mars = mars.replace(f"\nCH4 {here:g} ", f"\nCH4 @{there} ")
            (folder / "m.gases").write_text(mars.replace("@", ""))
            self.refused(folder, "is of another air: it holds 0.001 to 7 hPa and 180 to 320 K", "of this air's CH4 lies outside")

    def test_needs_a_profile(self):
        with Folder(own=SCENE.replace('"profile": "mid-latitude summer", "aerosol": {"type": "none"}%s', '"gas_model": "m.gases"').replace("%s", "") % ()) as folder:
            self.refused(folder, "profile")


if __name__ == "__main__":
    unittest.main()
