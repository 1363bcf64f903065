#!/usr/bin/env python3
"""Makes data/atmosphere/aerosol_components.txt.

    tools/make_aerosol_components.py OPAC data/atmosphere/aerosol_components.txt

OPAC is a folder with the files of components that come with OPAC (M. Hess, P. Koepke and I. Schult 1998), in version 4 as the
Python package AeroMix names them: IS00, WS00 to WS99, BC00, MDnm00, MDam00, MDcm00. Read from them: the parameters of the
sizes at each humidity and the index of refraction of the dry component, no more. Numbers of particles in the mixtures are those of
table 3 of the paper; the smoke is of O. Dubovik et al. (2002), table 1.
"""
import math
import pathlib
import re
import sys

ABOUT = """\
# Aerosols by what they consist of: spheres of lognormal sizes, mixed side by side.
# @component NAME DEVIATION INDEX: relative humidity %, median radius um by number, least and largest radius um.
# @index NAME: wavelength um, n, k (dry). @mixture TYPE COMPONENT NUMBER ...: numbers in any unit.
# OPAC: M. Hess, P. Koepke and I. Schult, Bull. Amer. Meteor. Soc. 79 (1998) 831-844; published figures. Free to use with citation.
# Smoke: O. Dubovik et al., J. Atmos. Sci. 59 (2002) 590-608, table 1, forest of Amazonia and savanna of Zambia at a depth of 1 at
# 440 nm; beyond 1.02 um, which they did not see, the index goes over to that of OPAC's water-soluble component at 2 um.
# Made by tools/make_aerosol_components.py; format in docs/formats/data.md.
"""

# name: prefix of the files, humidities, index
OPAC = {
    "insoluble": ("IS", [0], "insoluble"),
    "water_soluble": ("WS", [0, 50, 70, 80, 90, 95, 98, 99], "water_soluble"),
    "soot": ("BC", [0], "soot"),
    "mineral_nucleation": ("MDnm", [0], "mineral"),
    "mineral_accumulation": ("MDam", [0], "mineral"),
    "mineral_coarse": ("MDcm", [0], "mineral"),
}
# Hess et al. 1998, table 3, particles per cm3.
MIXTURES = {
    "continental_clean": {"water_soluble": 2600, "insoluble": 0.15},
    "continental_average": {"water_soluble": 7000, "insoluble": 0.4, "soot": 8300},
    "continental_polluted": {"water_soluble": 15700, "insoluble": 0.6, "soot": 34300},
    "desert": {"water_soluble": 2000, "mineral_nucleation": 269.5, "mineral_accumulation": 30.5,
               "mineral_coarse": 0.142},
}
# Dubovik et al. 2002, table 1, at a depth of 1 at 440 nm: n, k, and of the fine and the coarse mode the volume (um3 per um2 of ground),
# its median radius (um) and the deviation of its logarithm. Radii from 0.05 to 15 um were retrieved.
SMOKE = {
    "biomass_burning": ("smoke_of_forest", 1.47, 0.0093, (0.12, 0.14 + 0.013, 0.40), (0.05, 3.27 + 0.58, 0.79)),
    "savanna_burning": ("smoke_of_savanna", 1.51, 0.021, (0.12, 0.12 + 0.025, 0.40), (0.09, 3.22 + 0.71, 0.73)),
}
SEEN_UM, GOES_ON_UM, LARGEST_UM = (0.44, 1.02), 2.0, 15.0


def component(path):
    """Deviation, sizes (median, least, most) and the index by wavelength of one of OPAC's files."""
    text = path.read_text(encoding="latin-1")

    def one(words):
        return float(re.search(words + r"\s*(?:\[um\])?:\s*([0-9.E+-]+)", text)[1])

    index = []
    for line in text.splitlines():
        fields = [field.strip() for field in line.strip().rstrip(",").split(",")]
        if len(fields) == 9:
            index.append((float(fields[0]), float(fields[7]), -float(fields[8])))
    sizes = (one(r"Rmod ?\(wet\)"), one("minimum radius"), one("maximum radius"))
    return one("sigma"), sizes, index


def figure(value):
    return f"{value:.6g}"


def main():
    opac, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    sections, indices = [], {}
    for name, (prefix, humidities, index) in OPAC.items():
        values = []
        for humidity in humidities:
            deviation, sizes, of_file = component(opac / f"{prefix}{humidity:02}")
            if humidity == 0:
                indices.setdefault(index, of_file)
            values += [humidity, *sizes]
        sections.append((f"component {name} {figure(deviation)} {index}", values, 4))
    mixtures = {name: dict(parts) for name, parts in MIXTURES.items()}
    for name, (smoke, n, k, *modes) in SMOKE.items():
        indices[smoke] = [(um, n, k) for um in SEEN_UM]
        indices[smoke] += [row for row in indices["water_soluble"] if row[0] >= GOES_ON_UM]
        mixtures[name] = {}
        for mode, (volume, radius, width) in zip(("fine", "coarse"), modes):
            median = radius * math.exp(-3 * width**2)
            of_one = 4 / 3 * math.pi * median**3 * math.exp(4.5 * width**2)
            part = f"{smoke}_{mode}"
            sections.append((f"component {part} {figure(math.exp(width))} {smoke}",
                             [0, median, 0.001, LARGEST_UM], 4))
            mixtures[name][part] = volume / of_one
    for name, rows in indices.items():
        sections.append((f"index {name}", [value for row in rows for value in row], 12))
    for name, parts in mixtures.items():
        sections.append(("mixture " + " ".join([name] + [f"{p} {figure(c)}" for p, c in parts.items()]), [], 1))
    with open(out, "w") as text:
        text.write(ABOUT)
        for heading, values, per_line in sections:
            text.write(f"@{heading}\n")
            for i in range(0, len(values), per_line):
                text.write(" ".join(figure(value) for value in values[i : i + per_line]) + "\n")


if __name__ == "__main__":
    main()
