#!/usr/bin/env python3
"""Makes data/colorimetry.csv: colour-matching functions and D65 as the package colour-science has them (tried with 0.4.6).

    tools/make_colorimetry.py > data/colorimetry.csv
"""

import colour

HEAD = """\
# Colour-matching functions of the CIE 1931 standard observer (2 deg; ISO/CIE 11664-1) and relative spectral power of CIE
# standard illuminant D65 (ISO/CIE 11664-2), in steps of 5 nm from 380 to 780 nm. Figures of standards, taken from the tables that the
# package colour-science has of cvrl.org and of the CIE. Licence: BSD-3-Clause. Linear between points; nothing outside.
# Made by tools/make_colorimetry.py.
wavelength_um,x_bar,y_bar,z_bar,d65"""
FIRST_NM, LAST_NM, STEP_NM = 380, 780, 5


def main():
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    d65 = colour.SDS_ILLUMINANTS["D65"]
    print(HEAD)
    for nm in range(FIRST_NM, LAST_NM + 1, STEP_NM):
        row = [*observer[nm], d65[nm]]
        print(f"{nm / 1000:.3f}," + ",".join(f"{value:.10g}" for value in row))


if __name__ == "__main__":
    main()
