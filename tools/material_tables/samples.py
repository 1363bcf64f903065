"""Measured spectra as the library's files hold them: ascending wavelength in um, reflectance as a fraction."""
import csv
import re
from pathlib import Path

import numpy as np


class Sample:
    """Points of one spectrum. `gaps` are intervals without a measurement inside its range."""

    def __init__(self, wavelength_um, reflectance, title):
        order = np.argsort(wavelength_um)
        self.wavelength_um = np.asarray(wavelength_um, float)[order]
        self.reflectance = np.clip(np.asarray(reflectance, float)[order], 0.0, 1.0)
        keep = np.concatenate([[True], np.diff(self.wavelength_um) > 0])
        self.wavelength_um, self.reflectance = self.wavelength_um[keep], self.reflectance[keep]
        self.title = title
        self.join_step = None

    @property
    def first_um(self):
        return self.wavelength_um[0]

    @property
    def last_um(self):
        return self.wavelength_um[-1]

    def gaps(self, width_um=0.15):
        steps = np.diff(self.wavelength_um)
        wide = (steps > width_um) & (self.wavelength_um[:-1] < 2.5)
        return [(self.wavelength_um[i], self.wavelength_um[i + 1]) for i in np.flatnonzero(wide)]

    def at(self, wavelength_um):
        return np.interp(wavelength_um, self.wavelength_um, self.reflectance)


def ecostress(folder, *names):
    """A file of the ECOSTRESS or ASTER library; two of them are joined, the second from its first wavelength on."""
    parts = []
    for name in names:
        lines = (Path(folder) / name).read_text(encoding="latin-1").splitlines()
        fields = {m.group(1).strip().lower(): m.group(2).strip()
                  for m in (re.match(r"([A-Za-z. ]{2,30}):(.*)$", line) for line in lines) if m}
        percent = "percent" in fields["y units"].lower() or "%" in fields["y units"]
        rows = []
        for line in lines:
            words = line.split()
            if len(words) == 2:
                try:
                    rows.append((float(words[0]), float(words[1])))
                except ValueError:
                    continue
        x, y = np.array(rows).T
        number = fields["sample no."]
        owner = {"jhu": "Johns Hopkins University", "ucsb": "UC Santa Barbara", "jpl": "JPL"}.get(
            next((w for w in re.split(r"[._/]", name) if w in ("jhu", "ucsb", "jpl")), ""), "")
        title = " ".join(f"{fields['name']}, sample {number}, {owner}".split())
        parts.append(Sample(x, y * (0.01 if percent else 1.0), title))
    if len(parts) == 1:
        return parts[0]
    first, second = sorted(parts, key=lambda part: part.first_um)
    before = first.wavelength_um < second.first_um
    joined = Sample(np.concatenate([first.wavelength_um[before], second.wavelength_um]),
                    np.concatenate([first.reflectance[before], second.reflectance]), first.title)
    joined.join_step = (second.first_um, float(second.reflectance[0] - first.at(second.first_um)))
    return joined


def spectral_library(header_path, scale):
    """All spectra of an ENVI spectral library (double precision, little-endian) by name."""
    header = Path(header_path).read_text(encoding="latin-1")

    def braces(key):
        return [x.strip() for x in re.search(key + r"\s*=\s*\{(.*?)\}", header, re.S).group(1).split(",")]

    wavelength_um = np.array([float(x) for x in braces("wavelength")])
    names = braces("spectra names")
    values = np.fromfile(Path(header_path).with_suffix(".sli"), "<f8").reshape(len(names), len(wavelength_um))
    return {name: Sample(wavelength_um, row * scale, name) for name, row in zip(names, values)}


def table(path):
    """Two columns: wavelength_um, reflectance."""
    with open(path, encoding="utf-8") as file:
        rows = [row for row in csv.reader(line for line in file if not line.startswith("#")) if row]
    x, y = np.array([[float(v) for v in row[:2]] for row in rows[1:]]).T
    return Sample(x, y, Path(path).stem)


# Oscillators of A. D. Rakic et al., Applied Optics 37 (1998) 5271-5283, table 2: plasma frequency and, for each term,
# strength, width and frequency, in eV. The fits reach from 0.1 (silver, gold, copper) or 0.005 eV (aluminium) on.
LORENTZ_DRUDE = {
    "aluminium": (14.98, [0.523, 0.227, 0.050, 0.166, 0.030], [0.047, 0.333, 0.312, 1.351, 3.382],
                  [0.0, 0.162, 1.544, 1.808, 3.473], 14.0),
    "copper": (10.83, [0.575, 0.061, 0.104, 0.723, 0.638], [0.030, 0.378, 1.056, 3.213, 4.305],
               [0.0, 0.291, 2.957, 5.300, 11.18], 12.4),
    "gold": (9.03, [0.760, 0.024, 0.010, 0.071, 0.601, 4.384], [0.053, 0.241, 0.345, 0.870, 2.494, 2.214],
             [0.0, 0.415, 0.830, 2.969, 4.304, 13.32], 12.4),
    "silver": (9.01, [0.845, 0.065, 0.124, 0.011, 0.840, 5.646], [0.048, 3.886, 0.452, 0.065, 0.916, 2.419],
               [0.0, 0.816, 4.481, 8.185, 9.083, 20.29], 12.4),
}


def polished_metal(name, wavelength_um):
    """Fresnel reflectance at normal incidence, from the oscillators."""
    plasma, strengths, widths, frequencies, last_um = LORENTZ_DRUDE[name]
    wavelength_um = wavelength_um[wavelength_um <= last_um]
    energy = 1.239842 / wavelength_um
    permittivity = np.ones_like(energy, complex)
    for f, g, w in zip(strengths, widths, frequencies):
        permittivity += f * plasma ** 2 / (w ** 2 - energy ** 2 - 1j * energy * g)
    index = np.sqrt(permittivity)
    return Sample(wavelength_um, np.abs((index - 1) / (index + 1)) ** 2, f"{name}, polished")
