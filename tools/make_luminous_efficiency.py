#!/usr/bin/env python3
"""Makes data/luminous_efficiency.csv from a table of V(lambda) in steps of 1 nm: rows of nm and V, as cvrl.org gives them.

    tools/make_luminous_efficiency.py vl1924e_1.csv > data/luminous_efficiency.csv
"""

import sys

HEAD = """\
# Spectral luminous efficiency for photopic vision, V(lambda): CIE 1924, in steps of 5 nm (ISO 23539:2005 = CIE S
# 010). Figures of a standard, taken from the table of 1 nm that the Colour & Vision Research Laboratory gives (cvrl.org,
# "Older CIE Standards") as the package colour-science has it (BSD-3-Clause). Free to use with citation.
# Linear between points; nothing outside. Its integral is 106.857 nm. Made by tools/make_luminous_efficiency.py.
wavelength_um,efficiency"""
FIRST_NM, LAST_NM, STEP_NM = 360, 800, 5


def main():
    rows = {}
    with open(sys.argv[1], encoding="ascii") as file:
        for line in file:
            nm, efficiency = line.replace(",", " ").split()
            rows[round(float(nm))] = efficiency
    print(HEAD)
    for nm in range(FIRST_NM, LAST_NM + 1, STEP_NM):
        print(f"{nm / 1000:.3f},{float(rows[nm]):.10g}")


if __name__ == "__main__":
    main()
