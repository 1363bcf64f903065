"""ifov.sampling.integrate: means and intervals of functions of one's own, against closed forms."""

import subprocess
import sys
import time
import unittest

import numpy as np
import scenes

import ifov


def disc_in_pixel(cx, cy, r, x0, y0):
    """Area of a disc in the pixel, by the exact integral of its chords over strips of a ten-thousandth: to 1e-8."""
    x = x0 + (np.arange(10000) + 0.5) / 10000
    half = np.sqrt(np.maximum(r**2 - (x - cx) ** 2, 0.0))
    return np.clip(np.minimum(cy + half, y0 + 1) - np.maximum(cy - half, y0), 0, None).mean()


def discs():
    """24 discs about the middle one of 3 x 3 pixels, from half a pixel to twice as wide."""
    rng = np.random.default_rng(5)
    return [(*rng.uniform(0.8, 2.2, 2), rng.uniform(0.25, 1.0)) for _ in range(24)]


def held(trials, shrink=1.0):
    """Share of (mean, half-width, truth) whose interval, shrunk, holds the truth; 1e-5: that of single precision and of the truth."""
    off, half = np.array([(abs(mean - truth), half) for mean, half, truth in trials]).T
    return np.mean(off <= shrink * half + 1e-5)


class Integrals(unittest.TestCase):
    def test_discs_with_and_without_labels(self):
        of = {"labels": [], "values": []}
        samples = {"labels": 0, "values": 0}
        for seed, (cx, cy, r) in enumerate(discs(), 1):

            def inside(x, y, cx=cx, cy=cy, r=r):
                return (x - cx) ** 2 + (y - cy) ** 2 < r**2

            truth = np.array([[disc_in_pixel(cx, cy, r, i, j) for i in range(3)] for j in range(3)])
            border = (truth > 1e-6) & (truth < 1 - 1e-6)
            for name, labels in (("labels", inside), ("values", None)):
                ds = ifov.sampling.integrate(lambda x, y, inside=inside: 2.0 * inside(x, y), (3, 3), 0.05, labels=labels, seed=seed)
                self.assertTrue(ds["converged"].all())
                self.assertLessEqual(float(ds["half_width"].max()), 0.05)
                of[name] += zip(ds["mean"].values[border], ds["half_width"].values[border], 2 * truth[border], strict=True)
                samples[name] += int(ds["samples"].sum())
        for name, trials in of.items():
            self.assertGreater(len(trials), 80)
            # 95 % and its own scatter, of 80 to 150 pixels; the same errors with half-widths a quarter as large are not held.
            self.assertGreaterEqual(held(trials), 0.9, name)
            self.assertLess(held(trials, 0.25), 0.85, name)
        self.assertLess(5 * samples["labels"], samples["values"])

    def test_a_mean_over_random_numbers(self):
        """Of exp(u) + x y and of u v, over u and v from 0 to 1."""

        def field(x, y, u):
            return np.stack([np.exp(u[:, 0]) + x * y, u[:, 1] * u[:, 2]], axis=1)

        ds = ifov.sampling.integrate(field, (3, 4), "1 %", random=3)
        self.assertEqual(ds["mean"].dims, ("component", "y", "x"))
        x, y = np.meshgrid(ds["x"], ds["y"])
        truth = np.stack([np.e - 1 + x * y, np.full(x.shape, 0.25)])
        trials = list(zip(ds["mean"].values.ravel(), ds["half_width"].values.ravel(), truth.ravel(), strict=True))
        self.assertGreaterEqual(held(trials), 0.9)
        self.assertLessEqual(float((ds["half_width"] / ds["mean"]).max()), 0.010001)
        self.assertTrue(ds["converged"].all())

    def test_the_seed_alone_decides(self):
        def field(x, y, u):
            return x + u[:, 0]

        one, again, other = (ifov.sampling.integrate(field, (70, 3), 0.2, random=1, seed=seed) for seed in (1, 1, 2))
        np.testing.assert_array_equal(one["mean"], again["mean"])
        self.assertGreater(float(np.abs(one["mean"] - other["mean"]).max()), 0)
        # 70 rows are two tiles.
        self.assertLess(float(np.abs(one["mean"] - one["x"] - 0.5).max()), 0.3)

    def test_what_does_not_get_there_says_so(self):
        ds = ifov.sampling.integrate(lambda x, y, u: u[:, 0], (2, 2), 1e-6, random=1, max_samples=300)
        self.assertFalse(ds["converged"].any())
        self.assertIn("samples", ds["reasons"].attrs["flag_meanings"].split())
        self.assertTrue((ds["half_width"] > 1e-6).all())


class Errors(scenes.InFolder):
    def test_texts(self):
        def flat(x, y):
            return np.ones_like(x)

        integrate = ifov.sampling.integrate
        for call, words in (
            (lambda: integrate(flat, (2, 2), "1 K"), "error: found '1 K'; expected a number in the field's unit, or percent"),
            (lambda: integrate(flat, (2, 2), 0.0), "error: found 0; expected a number above 0"),
            (lambda: integrate(flat, (0, 2), 0.1), "shape: found 2 x 0 pixels; expected 1 to 1048576 each"),
            (lambda: integrate(flat, (2, 2), 0.1, confidence=1.0), r"confidence: found 1; expected 0.5 to 1 \(excluded\)"),
            (lambda: integrate(flat, (2, 2), 0.1, lattice=40), "lattice: found 40; expected 1 to 32"),
            (lambda: integrate(lambda x, y: 1.0, (2, 2)), r"field: found an answer of shape \(\) to one point"),
            (lambda: integrate(lambda x, y: np.ones(1), (2, 2)), r"field: found shape \(1,\) for \d+ points"),
            (lambda: integrate(lambda x, y: np.log(0 * x), (2, 2)), "field: found -inf at x = .*; expected a finite number"),
            (lambda: integrate(flat, (2, 2), labels=lambda x, y: x), "labels: found shape .* of float64; expected .* of whole numbers"),
        ):
            with np.errstate(divide="ignore"), self.assertRaisesRegex(ValueError, words):
                call()

    def test_what_the_field_throws_arrives(self):
        class Mine(Exception):
            pass

        def field(x, y):
            if len(x) > 1:
                raise Mine(str(len(x)))
            return x

        with self.assertRaises(Mine):
            ifov.sampling.integrate(field, (4, 4))

    def test_ctrl_c(self):
        code = (
            "import ifov, os, signal, threading\n"
            "threading.Timer(0.7, lambda: os.kill(os.getpid(), signal.SIGINT)).start()\n"
            "try: ifov.sampling.integrate(lambda x, y, u: u[:, 0], (400, 400), 1e-5, random=1)\n"
            "except KeyboardInterrupt: print('stopped')\n"
        )
        begun = time.monotonic()
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60)
        self.assertEqual(done.stdout.strip(), "stopped", done.stderr)
        self.assertLess(time.monotonic() - begun, 20)


if __name__ == "__main__":
    unittest.main()
