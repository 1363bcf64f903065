#!/usr/bin/env python3
"""Makes data/leaf/prospect.txt from the tables of coefficients of the leaf model PROSPECT.

    tools/make_leaf.py PROSPECT5 PROSPECT_PRO data/leaf

PROSPECT5 is the table of version 5 (Feret et al. 2008), a row a nm from 400 to 2500 nm: refractive index, specific absorption of
chlorophylls, carotenoids, brown pigments, water and dry matter. PROSPECT_PRO is dataSpec_PRO (Feret et al. 2021), which holds that
of version D (2017): wavelength in nm, refractive index, chlorophylls, carotenoids, anthocyanins, brown pigments, water, dry matter,
proteins and other carbon-based constituents; lines that start with '#' are skipped. Figures stay as they are given, those of
version 5 to the digits that single precision holds.
"""
import pathlib
import sys

HEAD = """\
# Coefficients of the leaf model PROSPECT, 1 nm: wavelength nm; version 5: refractive index, specific absorption of chlorophylls and
# carotenoids, cm2/ug; versions D and PRO: the same and anthocyanins, cm2/ug; all versions: brown pigments, water cm2/g, dry matter
# cm2/g; version PRO in place of dry matter: proteins, other carbon-based constituents, cm2/g.
# J.-B. Feret et al., PROSPECT-4 and 5, Remote Sensing of Environment 112 (2008) 3030-3043; PROSPECT-D, Remote Sensing of Environment 193
# (2017) 204-215; PROSPECT-PRO, Remote Sensing of Environment 252 (2021) 112173. Brown pigments: F. Baret, with his permission.
# Licence: MIT (tables of the R packages prospect, Copyright 2020 Jean-Baptiste Feret, and rrtm, Copyright 2019 Alexey Shiklomanov).
# Made by tools/make_leaf.py; format in docs/formats/data.md.
"""
FIRST, LAST = 400, 2500


def rows(path, columns):
    lines = [line.split() for line in path.read_text(encoding="utf-8").splitlines() if not line.lstrip().startswith("#")]
    found = [[float(word) for word in line] for line in lines if line]
    if len(found) != LAST - FIRST + 1 or any(len(row) != columns for row in found):
        sys.exit(f"{path}: not {LAST - FIRST + 1} rows of {columns} columns")
    return found


def main(five, pro, target):
    lines = []
    for nm, old, new in zip(range(FIRST, LAST + 1), rows(five, 6), rows(pro, 10)):
        if new[0] != nm:
            sys.exit(f"{pro}: {new[0]} nm in place of {nm}")
        if abs(old[3] - new[5]) > 1e-6 or abs(old[4] / new[6] - 1) > 1e-6 or abs(old[5] / new[7] - 1) > 2e-3:
            sys.exit(f"brown pigments, water or dry matter differ at {nm} nm")
        lines.append(" ".join(f"{value:.6g}" for value in [nm] + old[:3] + new[1:]))
    target.mkdir(parents=True, exist_ok=True)
    (target / "prospect.txt").write_text(HEAD + "\n".join(lines) + "\n", encoding="utf-8")
    print(f"{len(lines)} wavelengths")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*(pathlib.Path(argument) for argument in sys.argv[1:]))
