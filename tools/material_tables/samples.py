"""Measured spectra as the library's files hold them: ascending wavelength in um, reflectance as a fraction."""
import csv
from pathlib import Path

import numpy as np

DELETED = -1e30  # USGS marks deleted channels with -1.23e34


class Sample:
    """Points of one spectrum, whose `sources` are keys of `sources.SOURCES`. `gaps` are intervals without a measurement
    inside its range."""

    def __init__(self, wavelength_um, reflectance, title, sources):
        order = np.argsort(wavelength_um)
        self.wavelength_um = np.asarray(wavelength_um, float)[order]
        self.reflectance = np.clip(np.asarray(reflectance, float)[order], 0.0, 1.0)
        keep = np.concatenate([[True], np.diff(self.wavelength_um) > 0])
        self.wavelength_um, self.reflectance = self.wavelength_um[keep], self.reflectance[keep]
        self.title, self.sources = title, sources
        self.modelled = False

    @property
    def first_um(self):
        return self.wavelength_um[0]

    @property
    def last_um(self):
        return self.wavelength_um[-1]

    def gaps(self, width_um=0.15):
        wide = (np.diff(self.wavelength_um) > width_um) & (self.wavelength_um[:-1] < 8.0)
        return [(self.wavelength_um[i], self.wavelength_um[i + 1]) for i in np.flatnonzero(wide)]

    def at(self, wavelength_um):
        return np.interp(wavelength_um, self.wavelength_um, self.reflectance)


def _numbers(path):
    return np.array([float(line) for line in Path(path).read_text(encoding="latin-1").splitlines()[1:] if line.strip()])


class Usgs:
    """splib07a: one file of reflectances for each sample, one of wavelengths for each spectrometer."""

    WAVELENGTHS = {"ASDFR": "Wavelengths_ASD_0.35-2.5_microns_2151_ch", "BECK": "Wavelengths_BECK_Beckman_0.2-3.0_microns",
                   "NIC4": "Wavelengths_NIC4_Nicolet_1.12-216microns"}

    def __init__(self, folder):
        self.folder = Path(folder)

    def sample(self, name):
        """The file whose name goes on with `name` after splib07a_ and ends in AREF.txt."""
        found = sorted(path for path in self.folder.glob("splib07a_*AREF.txt")
                       if path.name[len("splib07a_"):].startswith(name))
        if len(found) != 1:
            raise SystemExit(f"{self.folder}: {len(found)} files for '{name}'")
        kind = next(key for key in self.WAVELENGTHS if key in found[0].name)
        x, y = _numbers(self.folder / f"splib07a_{self.WAVELENGTHS[kind]}.txt"), _numbers(found[0])
        record = found[0].read_text(encoding="latin-1").splitlines()[0].split("Record=")[-1].strip()
        keep = y > DELETED
        return Sample(x[keep], y[keep], "USGS splib07a " + " ".join(record.split()), ("usgs",))

    def joined(self, first, second):
        """The second from where the first ends."""
        a, b = self.sample(first), self.sample(second)
        beyond = b.wavelength_um > a.last_um
        return Sample(np.concatenate([a.wavelength_um, b.wavelength_um[beyond]]),
                      np.concatenate([a.reflectance, b.reflectance[beyond]]), f"{a.title} and {b.title}", ("usgs",))


class Slum:
    """Percent of reflectance over nm, and emissivity over um, both with one column for each sample."""

    def __init__(self, folder):
        self.short, self.thermal = (self._columns(Path(folder) / f"LUMA_SLUM_{part}.csv") for part in ("SW", "IR"))

    @staticmethod
    def _columns(path):
        with open(path, encoding="utf-8") as file:
            rows = list(csv.reader(file))
        values = np.array([[float(x) for x in row] for row in rows[1:] if row])
        return dict(zip(rows[0], values.T))

    def sample(self, name):
        x = np.concatenate([self.short["wavelength"] * 1e-3, self.thermal["wavelength"]])
        y = np.concatenate([self.short[name] * 1e-2, 1.0 - self.thermal[name]])
        return Sample(x, y, f"SLUM {name}", ("slum",))


def figure(reflectance, source, title, first_um):
    """One published figure, taken to hold from `first_um` to 14 um."""
    x = np.arange(first_um, 14.05, 0.1)
    return Sample(x, np.full(x.size, reflectance), title, (source,))


def levelled(sample, reflectance, source, title):
    """A spectrum whose level beyond 5 um is not that of a diffuse surface, scaled there so that its mean from 8 to 14 um is
    a published figure."""
    x = sample.wavelength_um
    factor = reflectance / np.mean(sample.at(np.linspace(8.0, 14.0, 601)))
    return Sample(x, sample.reflectance * np.interp(x, [5.0, 7.0], [1.0, factor]), title, sample.sources + (source,))


def mixture(parts):
    """Shares of samples, mixed by area, on the first one's wavelengths where all of them reach."""
    first = max(sample.first_um for _, sample in parts)
    last = min(sample.last_um for _, sample in parts)
    x = parts[0][1].wavelength_um
    x = x[(x >= first) & (x <= last)]
    y = sum(share * sample.at(x) for share, sample in parts)
    title = " and ".join(f"{share:.0%} of {sample.title}" for share, sample in parts)
    return Sample(x, y, "mixture by area: " + title, tuple(dict.fromkeys(s for _, p in parts for s in p.sources)))
