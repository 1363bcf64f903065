"""Refractive indices, and what Fresnel's equations make of them."""
from pathlib import Path

import numpy as np
import yaml


class Index:
    """Complex refractive index n + ik of files of the refractiveindex.info database, which continue each other."""

    def __init__(self, *paths):
        parts = [self._read(path) for path in paths]
        self.wavelength_um = np.concatenate([x for x, _ in parts])
        self.value = np.concatenate([value for _, value in parts])
        if np.any(np.diff(self.wavelength_um) <= 0):
            raise SystemExit(f"{paths}: wavelengths do not ascend")

    @staticmethod
    def _read(path):
        data = yaml.safe_load(Path(path).read_text(encoding="utf-8"))["DATA"]
        rows = {part["type"]: np.array([[float(x) for x in line.split()] for line in part["data"].splitlines()])
                for part in data if "data" in part}
        if "tabulated nk" in rows:
            x, n, k = rows["tabulated nk"].T
            return x, n + 1j * k
        x, k = rows["tabulated k"].T
        formula = next(part for part in data if part["type"] == "formula 5")
        c = [float(word) for word in formula["coefficients"].split()]
        n = c[0] + sum(a * x ** b for a, b in zip(c[1::2], c[2::2]))
        low, high = (float(word) for word in formula["wavelength_range"].split())
        keep = (x >= low) & (x <= high)
        return x[keep], (n + 1j * k)[keep]

    def at(self, wavelength_um):
        return (np.interp(wavelength_um, self.wavelength_um, self.value.real) +
                1j * np.interp(wavelength_um, self.wavelength_um, self.value.imag))


def face(index):
    """Fresnel reflectance of one face at normal incidence."""
    return np.abs((index - 1) / (index + 1)) ** 2


def absorption_per_cm(index, wavelength_um):
    return 4 * np.pi * index.imag / (wavelength_um * 1e-4)


def pane(index, wavelength_um, thickness_cm):
    """Reflectance of a pane at normal incidence: all reflections between its faces, without interference."""
    r = face(index)
    inner = np.exp(-absorption_per_cm(index, wavelength_um) * thickness_cm)
    return r + r * ((1 - r) * inner) ** 2 / (1 - (r * inner) ** 2)
