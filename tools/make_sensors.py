#!/usr/bin/env python3
"""Writes data/sensors/*.txt: bands of instruments and their noise, as their makers or the agencies that fly them publish them.

    python3 tools/make_sensors.py data/sensors

Each figure below was typed in from the page or paper that the `source` beside it names; where no noise was found there, none is told."""

import pathlib
import sys

HEAD = """# Bands of instruments and their noise, as published. `band: NAME from FIRST LAST` is a rectangle between the published edges,
# `band: NAME bell CENTRE FWHM` a bell, um; `snr RATIO RADIANCE` at a radiance in W m-2 sr-1 um-1, `nedt K AT_K`. Figures taken down in
# 2026. Licence: published figures, each cited. Made by tools/make_sensors.py; docs/formats/data.md describes the format.
"""

FIGURES = "a single published figure, cited"
PUBLIC = "public domain (work of the U.S. Government)"

MODIS = """
1 620 670 snr 128 21.8
2 841 876 snr 201 24.7
3 459 479 snr 243 35.3
4 545 565 snr 228 29.0
5 1230 1250 snr 74 5.4
6 1628 1652 snr 275 7.3
7 2105 2155 snr 110 1.0
8 405 420 snr 880 44.9
9 438 448 snr 838 41.9
10 483 493 snr 802 32.1
11 526 536 snr 754 27.9
12 546 556 snr 750 21.0
13 662 672 snr 910 9.5
14 673 683 snr 1087 8.7
15 743 753 snr 586 10.2
16 862 877 snr 516 6.2
17 890 920 snr 167 10.0
18 931 941 snr 57 3.6
19 915 965 snr 250 15.0
"""

# In um; the temperature is that of a black surface whose radiance the same table tells.
MODIS_THERMAL = """
20 3.660 3.840 nedt 0.05 300
21 3.929 3.989 nedt 2.00 335
22 3.929 3.989 nedt 0.07 300
23 4.020 4.080 nedt 0.07 300
24 4.433 4.498 nedt 0.25 250
25 4.482 4.549 nedt 0.25 275
26 1.360 1.390 snr 150 6.0
27 6.535 6.895 nedt 0.25 240
28 7.175 7.475 nedt 0.25 250
29 8.400 8.700 nedt 0.05 300
30 9.580 9.880 nedt 0.25 250
31 10.780 11.280 nedt 0.05 300
32 11.770 12.270 nedt 0.05 300
33 13.185 13.485 nedt 0.25 260
34 13.485 13.785 nedt 0.25 250
35 13.785 14.085 nedt 0.25 240
36 14.085 14.385 nedt 0.35 220
"""

OLI = """
1 0.435 0.451
2 0.452 0.512
3 0.533 0.590
4 0.636 0.673
5 0.851 0.879
6 1.566 1.651
7 2.107 2.294
8 0.503 0.676
9 1.363 1.384
"""

TIRS = """
10 10.60 11.19 nedt 0.05 300
11 11.50 12.51 nedt 0.05 300
"""

# Centre and width, nm.
MSI = """
B1 443 20
B2 490 65
B3 560 35
B4 665 30
B5 705 15
B6 740 15
B7 783 20
B8 842 115
B8A 865 20
B9 945 20
B10 1375 30
B11 1610 90
B12 2190 180
"""

# Centre and width, um.
SLSTR = """
S1 0.555 0.02
S2 0.659 0.02
S3 0.865 0.02
S4 1.375 0.015
S5 1.61 0.06
S6 2.25 0.05
S7 3.74 0.38
S8 10.85 0.9
S9 12 1
"""

ASTER = """
1 0.52 0.60
2 0.63 0.69
3N 0.78 0.86
4 1.600 1.700
5 2.145 2.185
6 2.185 2.225
7 2.235 2.285
8 2.295 2.365
9 2.360 2.430
10 8.125 8.475
11 8.475 8.825
12 8.925 9.275
13 10.25 10.95
14 10.95 11.65
"""


def edges(table, um=1.0):
    for line in table.split("\n"):
        if line:
            name, first, last, *noise = line.split()
            yield " ".join([name, "from", f"{float(first) * um:.6g}", f"{float(last) * um:.6g}", *noise])


def around_centre(table, um=1.0):
    for line in table.split("\n"):
        if line:
            name, centre, width = line.split()
            middle, half = float(centre) * um, 0.5 * float(width) * um
            yield f"{name} from {middle - half:.6g} {middle + half:.6g}"


HANDBOOK = ("U.S. Geological Survey, Landsat 8 (L8) Data Users Handbook, LSDS-1574 (2019), bands of OLI and TIRS; "
            "Landsat 9's are published as the same.", PUBLIC)
TIRS_NOISE = ("M. Montanaro, R. Levy, B. Markham, On-orbit radiometric performance of the Landsat 8 Thermal Infrared Sensor, Remote "
              "Sensing 6 (2014) 11753-11769, doi:10.3390/rs61211753: about 0.05 K at 300 K in both bands.", FIGURES)
MODIS_PAGE = ("NASA Goddard Space Flight Center, MODIS instrument specifications (atmosphere-imager.gsfc.nasa.gov, mcst.gsfc.nasa.gov; "
              "first published 1995): bandwidths, typical radiances, required SNR and NEdT.", PUBLIC)

GROUPS = {
    "landsat": [
        ("Landsat 8 OLI", "Reflected light, 30 m (band 8: 15 m). Nominal edges; no noise is told.", [HANDBOOK], edges(OLI)),
        ("Landsat 8 TIRS", "Thermal infrared, 100 m. Nominal edges; noise as measured in orbit.", [HANDBOOK, TIRS_NOISE], edges(TIRS)),
        ("Landsat 9 OLI-2", "As Landsat 8 OLI.", [HANDBOOK], edges(OLI)),
    ],
    "sentinel": [
        ("Sentinel-2 MSI", "10 m (B2, B3, B4, B8), 20 m and 60 m (B1, B9, B10). Nominal centres and widths; no noise is told.",
         [("European Space Agency, Sentinel-2 MSI user guide (2015), spatial and spectral resolution.", FIGURES)], around_centre(MSI, 1e-3)),
        ("Sentinel-3 SLSTR", "500 m (S1 to S6), 1 km (S7 to S9). Nominal centres and widths; no noise is told.",
         [("European Space Agency, Sentinel-3 SLSTR user guide (2016), radiometric resolution, table 1.", FIGURES)], around_centre(SLSTR)),
    ],
    "terra": [
        ("MODIS", "250 m (1, 2), 500 m (3 to 7), 1 km. Nominal edges; the noise is what was required at typical radiances.",
         [MODIS_PAGE], [*edges(MODIS, 1e-3), *edges(MODIS_THERMAL)]),
        ("ASTER", "15 m (1 to 3N), 30 m (4 to 9), 90 m (10 to 14). Nominal edges; no noise is told.",
         [("M. Abrams, S. Hook, B. Ramachandran, ASTER User Handbook, version 2, Jet Propulsion Laboratory (2002), table of bands.",
           PUBLIC)], edges(ASTER)),
    ],
}


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for group, sensors in GROUPS.items():
        text = HEAD
        for name, about, sources, bands in sensors:
            text += f"\nsensor: {name}\nabout: {about}\n"
            text += "".join(f"source: {source} Licence: {licence}.\n" for source, licence in sources)
            text += "".join(f"band: {band}\n" for band in bands)
        (folder / f"{group}.txt").write_text(text)


if __name__ == "__main__":
    main()
