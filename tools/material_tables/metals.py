"""Polished metals from published oscillators."""
import numpy as np

from . import indices
from .models import computed

# A. D. Rakic et al., Applied Optics 37 (1998) 5271-5283, table 2: plasma frequency and, for each term, strength, width and
# frequency, in eV; the longest wavelength of the fit, um.
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
    return computed(wavelength_um, indices.face(index), f"{name}, polished", ("rakic",))
