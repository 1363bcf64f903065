"""Surfaces that are computed from the properties of what they are made of."""
import numpy as np

from . import indices
from .samples import Sample

LIGHT_ZENITH_DEG = 45.0
POOL_DEPTH_CM, POOL_BOTTOM = 200.0, 0.5
INNER_MEAN = 0.48  # mean reflectance of a water surface from below for diffuse light (n 1.33)


def canopy(leaf, area, ground, dry, dry_share, shade, title):
    """A canopy of leaves in all directions, for light from LIGHT_ZENITH_DEG: J. Goudriaan, Crop Micrometeorology (1977);
    G. S. Campbell and J. M. Norman, An Introduction to Environmental Biophysics, 2nd ed. (1998), eqs. 15.7 to 15.10.

    `leaf` holds wavelengths, reflectance and transmittance; `area` is that of the leaves over that of the ground;
    `dry_share` the share of dry stems and litter in sight; `shade` the share that lies in the shade of the surface's own
    form (a crown's lobes, tufts) and is taken as black."""
    wavelength_um, reflectance, transmittance = leaf
    k = 0.5 / np.cos(np.radians(LIGHT_ZENITH_DEG))
    root = np.sqrt(np.clip(1.0 - reflectance - transmittance, 1e-6, 1.0))
    deep = 2 * k / (k + 1) * (1 - root) / (1 + root)
    under = ground.at(wavelength_um)
    through = (deep - under) / (deep * under - 1) * np.exp(-2 * root * k * area)
    green = (deep + through) / (1 + deep * through)
    values = (1 - shade) * ((1 - dry_share) * green + dry_share * dry.at(wavelength_um))
    return computed(wavelength_um, values, title, ("canopy", "prospect") + ground.sources)


def moist(dry, water, film_cm):
    """A soil whose pores are filled with water: A. Angstrom, Geografiska Annaler 7 (1925) 323, light that the water
    reflects back into the soil; and the absorption of a path of `film_cm` through water."""
    x = dry.wavelength_um
    index = water.at(x)
    values = dry.reflectance / (index.real ** 2 * (1 - dry.reflectance) + dry.reflectance)
    values = values * np.exp(-indices.absorption_per_cm(index, x) * film_cm)
    return computed(x, values, f"{dry.title}, with its pores full of water and a path of {film_cm * 10:g} mm through it",
                    dry.sources + ("hale",))


def pool(water, wavelength_um):
    """Clear water over a light bottom: its surface, and what returns from the bottom through it."""
    index = water.at(wavelength_um)
    r = indices.face(index)
    path = np.exp(-2 * indices.absorption_per_cm(index, wavelength_um) * POOL_DEPTH_CM) * POOL_BOTTOM
    values = r + (1 - r) * (1 - INNER_MEAN) * path / (1 - INNER_MEAN * path)
    return computed(wavelength_um, values, f"model, water {POOL_DEPTH_CM / 100:g} m deep over a bottom of reflectance "
                    f"{POOL_BOTTOM:g}", ("hale",))


def computed(wavelength_um, values, title, sources):
    sample = Sample(wavelength_um, values, title, sources)
    sample.modelled = True
    return sample
