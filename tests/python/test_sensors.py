"""ifov.sensors: instruments by name, and what follows of a document's sensor."""

import subprocess
import unittest

import numpy as np
import scenes

import ifov


def with_detector():
    document = scenes.small()
    document["sensor"] |= {
        "optics": {"f_number": 2, "throughput": 0.8},
        "detector": {
            "pitch": "15 um",
            "integration_time": "0.2 ms",
            "quantum_efficiency": 0.7,
            "read_noise": "400 e-",
            "full_well": "8 Me-",
            "bits": 14,
            "reference": {"radiance": "50 W/m2/sr/um"},
        },
    }
    return document


class Sensors(unittest.TestCase):
    def test_presets(self):
        names = [preset.name for preset in ifov.sensors.presets()]
        self.assertIn("Landsat 8 TIRS", names)
        listed = subprocess.run([scenes.PROGRAM, "sensors"], capture_output=True, text=True, check=True).stdout
        self.assertTrue(all(name in listed for name in names))
        tirs = ifov.sensors.find("landsat 8 tirs")
        self.assertEqual([channel["noise_temperature"] for channel in tirs.channels], ["0.05 K", "0.05 K"])
        self.assertEqual((tirs.bands, tirs.noise, tirs.ground), (2, "NEdT", "100 m"))
        np.testing.assert_allclose(tirs.range_um, (10.6, 12.51))
        camera = ifov.sensors.find("microbolometer")
        self.assertIn("microbolometer", camera.also)
        self.assertEqual(camera.document["sensor"]["detector"]["time_constant"], "12 ms")
        np.testing.assert_allclose(ifov.sensors.describe(camera.document)["step_share"], 1 - np.exp(-33.33 / 12), rtol=1e-6)
        with self.assertRaisesRegex(ifov.DocumentError, "did you mean 'Landsat 8 TIRS'"):
            ifov.sensors.find("Landsat 8 TIR")
        # Channels are those of the preset by name.
        document = scenes.small()
        document["sensor"]["channels"] = tirs.channels
        named = document | {"sensor": {"camera": document["sensor"]["camera"], "preset": tirs.name}}
        theirs = ifov.sensors.describe(named)
        np.testing.assert_array_equal(ifov.sensors.describe(document)["wavelength"], theirs["wavelength"])
        np.testing.assert_allclose(theirs["nedt"], 0.05, rtol=1e-6)

    def test_a_detector(self):
        told = ifov.sensors.describe(with_detector())
        self.assertEqual(list(told["channel"].values), ["red", "T"])
        self.assertEqual((told.attrs["width_px"], told.attrs["height_px"]), (20, 14))
        np.testing.assert_allclose(told["pixel_mtf"], 2 / np.pi, rtol=1e-12)
        # Photons, reading and rounding: docs/theory/detectors.md, equation 5.
        gain = 8e6 / (2**14 - 1)
        noise = np.sqrt(told["electrons"] + told["dark"] + told["background"] + 400.0**2 + gain**2 / 12)
        np.testing.assert_allclose(told["snr"], told["electrons"] / noise, rtol=1e-9)
        np.testing.assert_allclose(told["nedl"], told["radiance"] / told["snr"], rtol=1e-9)
        self.assertEqual(told["nedl"].attrs["units"], "W m-2 sr-1 um-1")

    def test_corners(self):
        document = with_detector()
        document["sensor"]["optics"]["vignetting"] = {"polynomial": [-0.4, 0.1]}
        told = ifov.sensors.describe(document)
        np.testing.assert_allclose(told["corner_light"], 0.7, rtol=1e-9)
        # Photons fall, what is read out does not: docs/theory/detectors.md, equations 5 and 12.
        gain = 8e6 / (2**14 - 1)
        light = 0.7 * told["electrons"]
        noise = np.sqrt(light + told["dark"] + told["background"] + 400.0**2 + gain**2 / 12)
        np.testing.assert_allclose(told["corner_snr"], light / noise, rtol=1e-9)
        np.testing.assert_allclose((told["corner_nedt"] / told["nedt"])[1], (told["snr"] / told["corner_snr"])[1], rtol=1e-6)
        self.assertTrue(np.isnan(ifov.sensors.describe(with_detector())["corner_light"]).all())

    def test_columns_mosaic_and_memory(self):
        document = with_detector()
        document["sensor"]["smile"] = {"polynomial": {"center": ["0 nm", "2 nm"]}}
        document["sensor"]["mosaic"] = [["red", "T"], ["T", "red"]]
        document["sensor"]["detector"] |= {"time_constant": "10 ms", "frame_period": "20 ms", "correction": {"low": {"radiance": "4 W/m2/sr/um"}, "high": {"radiance": "20 W/m2/sr/um"}, "frames": 25}}
        told = ifov.sensors.describe(document)
        self.assertEqual(told.attrs["mosaic"], "(red, T), (T, red)")
        np.testing.assert_allclose(told["step_share"], 1 - np.exp(-2), rtol=1e-6)
        np.testing.assert_allclose(told["memory_mtf"], np.tanh(1.0), rtol=1e-6)
        # The reference of 50 lies 46/16 of the way from one light to the other: docs/theory/detectors.md, equation 11.
        gain, share = 8e6 / (2**14 - 1), 46 / 16
        per_radiance = told["electrons"] / told["radiance"]
        low, high = (per_radiance * light + told["dark"] + told["background"] + 400.0**2 + gain**2 / 12 for light in (4, 20))
        np.testing.assert_allclose(told["correction_left"], np.sqrt(((1 - share) ** 2 * low + share**2 * high) / 25) / per_radiance, rtol=1e-6)
        self.assertTrue((told["centre_most"] > told["centre_least"]).all())

    def test_without_a_detector_nothing_is_told_of_it(self):
        told = ifov.sensors.describe(scenes.small())
        for name in ("electrons", "snr", "nedl", "nedt"):
            self.assertTrue(np.isnan(told[name]).all(), name)


if __name__ == "__main__":
    unittest.main()
