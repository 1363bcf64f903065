"""What is in the library: every material with its curves. How a curve comes about is a recipe, a function of the
`Library` of make_materials.py; `donor` names the sample that lends figures where a curve was not measured."""
from dataclasses import dataclass, field


@dataclass
class Curve:
    name: str
    recipe: object
    donor: str = ""
    leaf: bool = False     # transmittance by a fit of PROSPECT-D to the measured reflectance
    notes: tuple = ()


@dataclass
class Material:
    name: str
    words: str
    about: str
    curves: list = field(default_factory=list)
    instead_of: tuple = ()  # names of earlier libraries that a document may still hold


def usgs(name, file, donor, **more):
    return Curve(name, lambda library: library.usgs.sample(file), donor=donor, **more)


def slum(*names, **more):
    return [Curve(name, lambda library, name=name: library.slum.sample(name), **more) for name in names]


def mixed(name, *parts, donor):
    return Curve(name, lambda library: library.mixture(parts), donor=donor)


def prospect(name, *parameters, donor="leaf"):
    """Of a leaf: layers, then chlorophyll, carotenoids, anthocyanins (ug/cm2), brown pigments, water, dry matter (g/cm2)."""
    return Curve(name, lambda library: library.leaf(parameters), donor=donor)


def canopy(name, leaf, area, shade, dry=0.1, donor="canopy"):
    return Curve(name, lambda library: library.canopy(LEAVES[leaf], area, shade, dry), donor=donor)


SOIL, DRY = "Rangeland_L02-045", "Grass_Golden_Dry_GDS480"

LEAVES = {
    "mature": (1.5, 45, 9, 1, 0, 0.012, 0.006),
    "young": (1.3, 25, 6, 2, 0, 0.014, 0.004),
    "shade": (1.4, 60, 11, 1, 0, 0.009, 0.0035),
    "blade": (1.5, 30, 7, 1, 0.05, 0.013, 0.005),
    "tired blade": (1.6, 20, 6, 1, 0.3, 0.010, 0.006),
    "crop": (1.4, 50, 10, 1, 0, 0.015, 0.005),
    "old needle": (2.3, 55, 12, 1, 0.15, 0.030, 0.024),
    "new needle": (1.9, 35, 8, 1, 0.02, 0.025, 0.016),
}

# Samples that lend their figures.
DONORS = {
    "leaf": lambda library: library.figure(0.02, "lopez", "the emissivity of leaves, 0.98 (8 to 14 um)", 2.7),
    "canopy": lambda library: library.figure(0.02, "sutherland", "the emissivity of grass, 0.98 (8 to 14 um)", 2.7),
    "dry grass": lambda library: library.figure(0.03, "sutherland", "the emissivity of grass, 0.97 (8 to 14 um)", 2.7),
    "clay": lambda library: library.figure(0.04, "sutherland", "the emissivity of clay, 0.96 (8 to 14 um)", 8.0),
    "muck": lambda library: library.figure(0.03, "sutherland", "the emissivity of muck, 0.97 (8 to 14 um)", 8.0),
    "wood": lambda library: library.figure(0.10, "hottel", "the emissivity of planed oak, 0.90", 8.0),
    "quartz sand": lambda library: library.quartz_sand(),
    "water": lambda library: library.water(),
    "ice": lambda library: library.ice(),
    "aluminium": lambda library: library.metal("aluminium"),
    "concrete": lambda library: library.slum.sample("C004"),
    "brick": lambda library: library.slum.sample("B013"),
    "asphalt": lambda library: library.slum.sample("A006"),
    "roofing asphalt": lambda library: library.slum.sample("A007"),
    "PVC sheet": lambda library: library.slum.sample("V002"),
    "limestone": lambda library: library.slum.sample("S004"),
    "aluminium-zinc": lambda library: library.slum.sample("Z001"),
    "black iron": lambda library: library.slum.sample("Z008"),
    "painted metal": lambda library: library.slum.sample("Z005"),
}
