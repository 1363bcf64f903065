#!/usr/bin/env python3
"""Writes data/sensors/*.txt: bands of instruments, their noise, optics, detectors and geometry, as their makers or those who fly or measured
them publish it.

    python3 tools/make_sensors.py data/sensors

Each figure below is of the page or paper that the `source` beside it names; what was found nowhere is not told. What is worked
out of published figures (noise of spectrometers, the efficiency of the DSLR) is worked out here."""

import json
import math
import pathlib
import sys

HEAD = """# Instruments as published; docs/formats/data.md describes the format. Figures taken down in 2026. Licence: published figures, each cited.
# Made by tools/make_sensors.py.
"""

FIGURES = "single published figures, cited"
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

# Name, edges; SNR that was required, at a radiance in W m-2 sr-1 um-1.
OLI = """
1 0.435 0.451 snr 130 40
2 0.452 0.512 snr 130 40
3 0.533 0.590 snr 100 30
4 0.636 0.673 snr 90 22
5 0.851 0.879 snr 90 14
6 1.566 1.651 snr 100 4.0
7 2.107 2.294 snr 100 1.7
8 0.503 0.676 snr 80 23
9 1.363 1.384 snr 50 6.0
"""

TIRS = """
10 10.60 11.19 nedt 0.05 300
11 11.50 12.51 nedt 0.05 300
"""

# Required.
TIRS_2 = """
10 10.60 11.19 nedt 0.4 300
11 11.50 12.51 nedt 0.4 300
"""

# Centre and width, nm.
MSI = """
B1 443 20 snr 129 129
B2 490 65 snr 154 128
B3 560 35 snr 168 128
B4 665 30 snr 142 108
B5 705 15 snr 117 74.5
B6 740 15 snr 89 68
B7 783 20 snr 105 67
B8 842 115 snr 174 103
B8A 865 20 snr 72 52.5
B9 945 20 snr 114 9
B10 1375 30 snr 50 6
B11 1610 90 snr 100 4
B12 2190 180 snr 100 1.5
"""

# Centre and width, um.
SLSTR = """
S1 0.555 0.02
S2 0.659 0.02
S3 0.865 0.02
S4 1.375 0.015
S5 1.61 0.06
S6 2.25 0.05
S7 3.74 0.38 nedt 0.08 270
S8 10.85 0.9 nedt 0.05 270
S9 12 1 nedt 0.05 270
"""

# Centre and width, nm.
OLCI = """
Oa1 400 15 snr 2188 62.95
Oa2 412.5 10 snr 2061 74.14
Oa3 442.5 10 snr 1811 65.61
Oa4 490 10 snr 1541 51.21
Oa5 510 10 snr 1488 44.39
Oa6 560 10 snr 1280 31.49
Oa7 620 10 snr 997 21.14
Oa8 665 10 snr 883 16.38
Oa9 673.75 7.5 snr 707 15.70
Oa10 681.25 7.5 snr 745 15.11
Oa11 708.75 10 snr 785 12.73
Oa12 753.75 7.5 snr 605 10.33
Oa13 761.25 2.5 snr 232 6.09
Oa14 764.375 3.75 snr 305 7.13
Oa15 767.5 2.5 snr 330 7.58
Oa16 778.75 15 snr 812 9.18
Oa17 865 20 snr 666 6.17
Oa18 885 10 snr 395 6.00
Oa19 900 10 snr 308 4.73
Oa20 940 20 snr 203 2.39
Oa21 1020 40 snr 152 3.86
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
10 8.125 8.475 nedt 0.3 300
11 8.475 8.825 nedt 0.3 300
12 8.925 9.275 nedt 0.3 300
13 10.25 10.95 nedt 0.3 300
14 10.95 11.65 nedt 0.3 300
"""

VIIRS = """
M1 0.402 0.422 snr 352 44.9
M2 0.436 0.454 snr 380 40
M3 0.478 0.498 snr 416 32
M4 0.545 0.565 snr 362 21
M5 0.662 0.682 snr 242 10
M6 0.739 0.754 snr 199 9.6
M7 0.846 0.885 snr 215 6.4
M8 1.230 1.250 snr 74 5.4
M9 1.371 1.386 snr 83 6
M10 1.580 1.640 snr 342 7.3
M11 2.225 2.275 snr 10 0.12
M12 3.660 3.840 nedt 0.396 270
M13 3.973 4.128 nedt 0.107 300
M14 8.400 8.700 nedt 0.091 270
M15 10.263 11.263 nedt 0.070 300
M16 11.538 12.488 nedt 0.072 300
I1 0.600 0.680 snr 119 22
I2 0.846 0.885 snr 150 25
I3 1.580 1.640 snr 6 7.3
I4 3.550 3.930 nedt 2.5 270
I5 10.500 12.400 nedt 1.5 210
DNB 0.500 0.900
"""

# Centre and width, um.
ECOSTRESS = """
1 8.29 0.354
2 8.78 0.310
3 9.20 0.396
4 10.49 0.410
5 12.09 0.611
"""

# Edges, nm.
WORLDVIEW_3 = """
PAN 450 800
COASTAL 400 450
BLUE 450 510
GREEN 510 580
YELLOW 585 625
RED 630 690
REDEDGE 705 745
NIR1 770 895
NIR2 860 1040
SWIR1 1195 1225
SWIR2 1550 1590
SWIR3 1640 1680
SWIR4 1710 1750
SWIR5 2145 2185
SWIR6 2185 2225
SWIR7 2235 2285
SWIR8 2295 2365
"""

SUPERDOVE = """
Coastal_Blue 431 452
Blue 465 515
Green_I 513 549
Green_II 547 583
Yellow 600 620
Red 650 680
RedEdge 697 713
NIR 845 885
"""

# Centres of the spectrometers of prisms, nm, as their products have them.
ENMAP_VNIR = [
    418.24, 423.874, 429.294, 434.528, 439.603, 444.549, 449.391, 454.159, 458.884, 463.584, 468.265, 472.934, 477.599, 482.265, 486.941, 491.633,
    496.349, 501.094, 505.87, 510.678, 515.519, 520.397, 525.313, 530.268, 535.265, 540.305, 545.391, 550.525, 555.71, 560.947, 566.239, 571.587,
    576.995, 582.464, 587.997, 593.596, 599.267, 605.011, 610.833, 616.737, 622.732, 628.797, 634.919, 641.1, 647.341, 653.643, 660.007, 666.435,
    672.927, 679.485, 686.11, 692.804, 699.567, 706.401, 713.307, 720.282, 727.324, 734.431, 741.601, 748.833, 756.124, 763.472, 770.876, 778.333,
    785.843, 793.402, 801.01, 808.665, 816.367, 824.112, 831.901, 839.731, 847.601, 855.509, 863.455, 871.433, 879.442, 887.478, 895.537, 903.617,
    911.715, 919.827, 927.951, 936.082, 944.217, 952.355, 960.495, 968.638, 976.783, 984.932, 993.083]
ENMAP_SWIR = [
    902.257, 911.872, 921.624, 931.512, 941.53, 951.677, 961.948, 972.341, 982.851, 993.475, 1004.21, 1015.05, 1026.0, 1037.05, 1048.19, 1059.42,
    1070.74, 1082.14, 1093.62, 1105.17, 1116.79, 1128.47, 1140.2, 1151.98, 1163.81, 1175.67, 1187.56, 1199.48, 1211.42, 1223.37, 1235.34, 1247.31,
    1259.3, 1271.29, 1283.29, 1295.28, 1307.27, 1319.25, 1331.22, 1343.18, 1355.13, 1367.06, 1378.96, 1390.84, 1461.46, 1473.1, 1484.69, 1496.24,
    1507.75, 1519.22, 1530.64, 1542.02, 1553.36, 1564.65, 1575.9, 1587.1, 1598.26, 1609.36, 1620.43, 1631.44, 1642.41, 1653.33, 1664.2, 1675.03,
    1685.8, 1696.53, 1707.2, 1717.83, 1728.4, 1738.93, 1749.4, 1759.83, 1939.44, 1948.98, 1958.49, 1967.95, 1977.37, 1986.74, 1996.07, 2005.36,
    2014.61, 2023.82, 2032.99, 2042.11, 2051.19, 2060.24, 2069.24, 2078.21, 2087.13, 2096.01, 2104.86, 2113.67, 2122.44, 2131.17, 2139.87, 2148.52,
    2157.15, 2165.73, 2174.28, 2182.79, 2191.27, 2199.71, 2208.12, 2216.5, 2224.84, 2233.14, 2241.42, 2249.66, 2257.86, 2266.04, 2274.18, 2282.29,
    2290.37, 2298.42, 2306.44, 2314.42, 2322.37, 2330.29, 2338.19, 2346.05, 2353.88, 2361.68, 2369.45, 2377.19, 2384.9, 2392.58, 2400.23, 2407.85,
    2415.45, 2423.01, 2430.55, 2438.05, 2445.53]
PRISMA_VNIR = [
    406.9934, 415.839, 423.78476, 431.3347, 438.6569, 446.0147, 453.38947, 460.73175, 468.09842, 475.31885, 482.54816, 489.79486, 497.05865, 504.51172,
    512.0464, 519.54376, 527.3053, 535.05255, 542.88513, 550.9146, 559.02026, 567.2061, 575.4868, 583.8441, 592.339, 601.0144, 609.9582, 618.72,
    627.77844, 636.6763, 645.9638, 655.41876, 664.8941, 674.46436, 684.13727, 694.12836, 703.737, 713.72687, 723.87994, 733.9552, 744.14954, 754.4696,
    764.85645, 775.2735, 785.65955, 796.127, 806.71106, 817.31104, 827.9195, 838.5272, 849.20996, 859.97314, 870.74255, 881.45605, 892.08093, 902.80164,
    913.44507, 923.9502, 934.11206, 944.6273, 956.2715, 967.0267, 977.3654]
PRISMA_SWIR = [
    979.224, 988.9179, 998.9082, 1008.6443, 1018.5357, 1029.344, 1037.9878, 1047.675, 1057.5737, 1067.7948, 1078.2161, 1088.761, 1099.2776, 1109.8894,
    1120.6759, 1131.3048, 1142.0703, 1152.6501, 1163.676, 1174.7142, 1185.5884, 1196.3394, 1207.2737, 1217.8635, 1229.1852, 1240.2145, 1250.9799,
    1262.5322, 1273.4963, 1284.4878, 1295.4218, 1306.218, 1317.2566, 1328.2993, 1339.1294, 1349.7877, 1361.0531, 1372.9117, 1383.2798, 1394.754,
    1405.6268, 1416.5374, 1427.3748, 1438.466, 1449.1888, 1459.3157, 1469.9308, 1480.8422, 1491.4292, 1502.0236, 1512.6333, 1523.2222, 1533.7764,
    1544.2262, 1554.8168, 1565.3688, 1575.6274, 1585.8597, 1596.2454, 1606.4913, 1616.8336, 1627.021, 1637.0919, 1647.2316, 1656.933, 1667.185,
    1677.3193, 1687.4269, 1697.2943, 1707.0945, 1716.8589, 1726.6516, 1736.4883, 1746.2192, 1755.833, 1765.5127, 1775.1178, 1784.7173, 1793.9531,
    1803.5902, 1813.0514, 1822.4413, 1832.0272, 1841.3256, 1850.5543, 1859.5587, 1868.1732, 1878.7426, 1887.081, 1896.0913, 1904.9347, 1914.3015,
    1923.3857, 1932.2599, 1941.1107, 1949.9008, 1958.6244, 1967.3418, 1976.013, 1984.853, 1993.5482, 2002.1106, 2010.6614, 2019.3214, 2027.7267,
    2036.2607, 2044.6809, 2053.0078, 2061.3787, 2069.7957, 2077.9915, 2086.3823, 2094.6252, 2102.8213, 2111.039, 2119.2314, 2127.3372, 2135.5103,
    2143.4656, 2151.3862, 2159.564, 2167.4849, 2175.3442, 2183.4202, 2191.1003, 2199.1353, 2206.843, 2214.625, 2222.4263, 2230.0076, 2237.904,
    2245.4485, 2253.1104, 2260.8665, 2268.2883, 2276.0537, 2283.4934, 2290.8267, 2298.6094, 2305.7227, 2313.2007, 2320.8955, 2327.8242, 2335.5264,
    2342.8228, 2349.7915, 2357.2937, 2364.5945, 2371.5522, 2378.771, 2386.0618, 2393.0388, 2400.036, 2407.6045, 2414.3567, 2421.2373, 2428.6677,
    2435.5442, 2442.403, 2449.1423, 2456.5857, 2463.0303, 2469.6272, 2477.055, 2483.793, 2490.2192, 2497.1155]
# Number of the channel and its centre, nm: linear in between.
EMIT = [(0, 381.0056), (71, 909.8289), (142, 1439.2920), (213, 1967.2518), (276, 2433.8303), (284, 2493.0)]

# Wavelength, nm; a and b of the noise a sqrt(b + L), both radiances in uW cm-2 sr-1 nm-1.
EMIT_NOISE = [
    (381.006, 0.00583760, 3.02705843), (447.743, 0.00538509, 2.57594608), (499.771, 0.00501900, 2.23761962), (559.314, 0.00460410, 1.88296391),
    (648.730, 0.00472930, 1.98675952), (753.136, 0.00384679, 1.31446423), (865.055, 0.00398678, 1.41187365), (999.373, 0.00422697, 1.58712298),
    (1044.138, 0.00426106, 1.61282648), (1245.515, 0.00322160, 0.92192793), (1550.989, 0.00218850, 0.42544765), (1647.730, 0.00202568, 0.36445974),
    (1751.841, 0.00191294, 0.32505379), (2048.865, 0.00175770, 0.27443601), (2204.503, 0.00173089, 0.26612894), (2300.738, 0.00173793, 0.26829964),
    (2426.440, 0.00176677, 0.27727982)]
AVIRIS_NG_NOISE = [
    (380, 0.028668091568, 10.545959959), (400, 0.022902736591, 6.580043982), (450, 0.012838012676, 2.034281581), (500, 0.013123071703, 2.134147627),
    (550, 0.009802466389, 1.193935170), (650, 0.009862340223, 1.204418154), (750, 0.009300352712, 1.078953613), (850, 0.008517030962, 0.905239192),
    (1000, 0.007407088439, 0.682748256), (1100, 0.006605887334, 0.539075622), (1250, 0.005277957153, 0.346503805), (1300, 0.004820379436, 0.290663183),
    (1550, 0.003646734864, 0.165543864), (1650, 0.003323382917, 0.134949698), (1750, 0.003094641257, 0.117479164), (2050, 0.002849565066, 0.100861890),
    (2200, 0.002892175100, 0.104090470), (2300, 0.002785276461, 0.099452819), (2400, 0.002813595761, 0.104480103), (2495, 0.002781517325, 0.157152949)]
# Wavelength, nm, and noise, uW cm-2 sr-1 nm-1.
HYTES_NOISE = [
    (7513.0, 5.7639e-3), (7601.6, 5.1399e-3), (7707.5, 3.9873e-3), (7795.7, 3.5136e-3), (7901.6, 3.1542e-3), (8095.7, 3.2383e-3), (8183.9, 3.7293e-3),
    (8307.5, 3.3171e-3), (8501.6, 3.3592e-3), (8748.6, 3.5939e-3),
    (9754.5, 2.3198e-3), (9913.4, 1.9195e-3), (10090.0, 1.6554e-3), (10319.0, 1.7448e-3), (10496.0, 1.7017e-3), (10743.0, 1.7976e-3),
    (10902.0, 2.0986e-3), (11096.0, 2.4966e-3), (11209.0, 2.5310e-3), (11333.0, 2.9945e-3), (11403.0, 3.5152e-3), (11474.0, 4.3050e-3),
    (11597.0, 6.2785e-3), (11703.0, 8.1839e-3), (11809.0, 1.03277e-2), (12021.0, 1.32395e-2)]

# Numbers and bells of the DSLR: where its curves are half of their peaks, um, and their peaks.
DSLR_BELLS = [("red", 0.5769, 0.6343, 0.74372, 0.590), ("green", 0.4954, 0.5772, 1.0, 0.530), ("blue", 0.4229, 0.5003, 0.91167, 0.460)]
DSLR_PITCH_M, DSLR_WELL, DSLR_SPEED = 36e-3 / 4256, 65600, 200


def bands(table, um=1.0):
    """Between edges."""
    for line in table.split("\n"):
        if line:
            name, first, last, *noise = line.split()
            yield " ".join(["band:", name, "from", f"{float(first) * um:.6g}", f"{float(last) * um:.6g}", *noise])


def around_centre(table, um=1.0):
    for line in table.split("\n"):
        if line:
            name, centre, width, *noise = line.split()
            middle, half = float(centre) * um, 0.5 * float(width) * um
            yield " ".join(["band:", name, "from", f"{middle - half:.6g}", f"{middle + half:.6g}", *noise])


def series(centres_nm, width_nm, within_nm=0.5):
    """As few equal steps as come within so much of all centres."""
    begin = 0
    while begin < len(centres_nm):
        end = begin + 1
        for last in range(begin + 1, len(centres_nm)):
            first, step = centres_nm[begin], (centres_nm[last] - centres_nm[begin]) / (last - begin)
            if all(abs(first + step * (k - begin) - centres_nm[k]) <= within_nm for k in range(begin, last)):
                end = last + 1
            elif centres_nm[last] - centres_nm[last - 1] > 30.0:  # what water vapour leaves out
                break
        if end - begin == 1:
            raise SystemExit(f"no series begins at {centres_nm[begin]} nm")
        if end == len(centres_nm) - 1:  # leaves two for the last
            end -= 1
        yield f"series: {centres_nm[begin] * 1e-3:.6g} {centres_nm[end - 1] * 1e-3:.6g} {end - begin} {width_nm * 1e-3:.6g}"
        begin = end


def through(knots):
    """All centres of a table of some."""
    return [
        first + (last - first) * (k - a) / (b - a) for (a, first), (b, last) in zip(knots, knots[1:]) for k in range(a, b)
    ] + [knots[-1][1]]


def noise(points):
    return "noise: " + " ".join(f"{nm * 1e-3:.6g} {radiance:.4g}" for nm, radiance in points)


def noise_under_sun(points):
    """At the radiance of a diffuse surface of reflectance 0.3 under the Sun at 45 deg, without air."""
    data = pathlib.Path(__file__).resolve().parents[1] / "data/solar_irradiance.csv"
    sun = [tuple(map(float, line.split(","))) for line in data.read_text().split("\n") if line[:1].isdigit()]

    def radiance(nm):
        (a, low), (b, high) = next(pair for pair in zip(sun, sun[1:]) if pair[0][0] <= nm * 1e-3 <= pair[1][0])
        return 0.3 * math.cos(math.radians(45)) / math.pi * (low + (high - low) * (nm * 1e-3 - a) / (b - a))

    # 1 uW cm-2 sr-1 nm-1 is 10 W m-2 sr-1 um-1.
    return noise((nm, 10.0 * a * math.sqrt(b + 0.1 * radiance(nm))) for nm, a, b in points)


def dslr():
    """Bells, and efficiencies by the speed: 78 lx s over it fill a green well (ISO 12232), in light of CIE D65."""
    data = pathlib.Path(__file__).resolve().parents[1] / "data/colorimetry.csv"
    rows = [line.split(",") for line in data.read_text().split("\n") if line and not line.startswith("#")]
    light = [dict(zip(rows[0], map(float, row))) for row in rows[1:]]
    step_um = light[1]["wavelength_um"] - light[0]["wavelength_um"]
    lux_seconds = 683.0 * step_um * sum(d["d65"] * d["y_bar"] for d in light)
    exposure = 78.0 / DSLR_SPEED / lux_seconds  # J m-2 um-1 for a unit of D65
    _, first, last, _, peak_um = DSLR_BELLS[1]
    bell = [math.exp(-4.0 * math.log(2.0) * ((d["wavelength_um"] - 0.5 * (first + last)) / (last - first)) ** 2) for d in light]
    photons = DSLR_PITCH_M**2 * step_um * sum(
        exposure * d["d65"] * b * d["wavelength_um"] * 1e-6 / (6.62607015e-34 * 299792458.0) for d, b in zip(light, bell))
    green = DSLR_WELL / photons
    for name, first, last, peak, at_um in DSLR_BELLS:
        efficiency = green * peak / at_um * peak_um  # curves are per energy
        yield f"band: {name} bell {0.5 * (first + last):.5g} {last - first:.4g} efficiency {efficiency:.2g}"


def told(key, value):
    return f"{key}: {json.dumps(value)}"


def pushbroom(focal_length, pitch, line_period, altitude_m, speed_m_s):
    lines = {"pixels": [64, 64], "focal_length": focal_length, "pitch": pitch, "line_period": line_period}
    half_s = 32 * float(line_period.split()[0]) * 1e-3
    flight = {"frame": "scene", "position": ["0 m", f"{-half_s * speed_m_s:.4g} m", f"{altitude_m:g} m"],
              "velocity": ["0 m/s", f"{speed_m_s:g} m/s", "0 m/s"]}
    return [told("camera", {"pushbroom": lines}), told("platform", {"straight": flight})]


def frame(focal_length, pitch, pixels):
    return told("camera", {"frame": {"focal_length": focal_length, "pitch": pitch, "pixels": pixels,
                                     "position": ["0 m", "0 m", "100 m"], "attitude": {}}})


HANDBOOK = ("U.S. Geological Survey, Landsat 8 (L8) Data Users Handbook, LSDS-1574 (2019), bands of OLI and TIRS; "
            "Landsat 9's are published as the same.", PUBLIC)
OLI_NOISE = ("J. R. Irons, J. L. Dwyer, J. A. Barsi, The next Landsat satellite: the Landsat Data Continuity Mission, Remote Sensing of "
             "Environment 122 (2012) 11-21, doi:10.1016/j.rse.2011.08.026: required signal-to-noise ratios at typical radiances.", FIGURES)
OLI_DESIGN = ("E. J. Knight, G. Kvaran, Landsat-8 Operational Land Imager design, characterization and performance, Remote Sensing 6 (2014) "
              "10286-10305, doi:10.3390/rs61110286: telescope of 135 mm and f/6.4, elements of 36 um, lines every 4.236 ms.", FIGURES)
TIRS_NOISE = ("M. Montanaro, R. Levy, B. Markham, On-orbit radiometric performance of the Landsat 8 Thermal Infrared Sensor, Remote "
              "Sensing 6 (2014) 11753-11769, doi:10.3390/rs61211753: about 0.05 K at 300 K in both bands.", FIGURES)
TIRS_DESIGN = ("D. C. Reuter et al., The Thermal Infrared Sensor (TIRS) on Landsat 8: design overview and pre-launch characterization, Remote "
               "Sensing 7 (2015) 1135-1153, doi:10.3390/rs70101135: f/1.64, 178 mm, elements of 25 um, 70 lines a second, 0.4 K required at "
               "300 K.", FIGURES)
MODIS_PAGE = ("NASA Goddard Space Flight Center, MODIS instrument specifications (atmosphere-imager.gsfc.nasa.gov, mcst.gsfc.nasa.gov; "
              "first published 1995): bandwidths, typical radiances, required SNR and NEdT.", PUBLIC)
ISOFIT = ("Jet Propulsion Laboratory, ISOFIT (github.com/isofit/isofit, 2018 to 2024), data/{}: {}.", "Apache 2.0; some figures of it")
ORBIT_SPEED_M_S = 6780  # over the ground, from 705 km


def isofit(file, what):
    return ISOFIT[0].format(file, what), ISOFIT[1]


OLI_PARTS = [*pushbroom("886 mm", "36 um", "4.236 ms", 705e3, ORBIT_SPEED_M_S), told("optics", {"f_number": 6.4})]
TIRS_PARTS = [*pushbroom("178 mm", "25 um", "14.29 ms", 705e3, ORBIT_SPEED_M_S), told("optics", {"f_number": 1.64})]

# Each: name, other names, what it is, size of a pixel on the ground or the kind of camera, sources, figures.
GROUPS = {
    "landsat": [
        ("Landsat 8 OLI", "OLI", "Reflected light from 705 km. Nominal edges; the noise is what was required at typical radiances, and less in orbit.",
         "30 m, band 8 15 m", [HANDBOOK, OLI_NOISE, OLI_DESIGN], [*bands(OLI), *OLI_PARTS]),
        ("Landsat 8 TIRS", "TIRS", "Thermal infrared from 705 km. Nominal edges; noise as measured in orbit.", "100 m",
         [HANDBOOK, TIRS_NOISE, TIRS_DESIGN], [*bands(TIRS), *TIRS_PARTS]),
        ("Landsat 9 OLI-2", "Landsat 9 OLI; OLI-2", "As Landsat 8 OLI.", "30 m, band 8 15 m", [HANDBOOK, OLI_NOISE, OLI_DESIGN],
         [*bands(OLI), *OLI_PARTS]),
        ("Landsat 9 TIRS-2", "Landsat 9 TIRS; TIRS-2",
         "As Landsat 8 TIRS, which it repeats. Nominal edges: band 10 of the instrument that flies is a quarter wider. The noise is what was required.",
         "100 m", [HANDBOOK, TIRS_DESIGN], [*bands(TIRS_2), *TIRS_PARTS]),
    ],
    "sentinel": [
        ("Sentinel-2 MSI", "MSI; Sentinel-2", "Reflected light from 786 km. Nominal centres and widths; the noise is what was required.",
         "10 m (B2 to B4, B8), 20 m, 60 m (B1, B9, B10)",
         [("European Space Agency, Sentinel-2 MSI user guide (2015), spatial and spectral resolution.", FIGURES),
          ("M. Drusch et al., Sentinel-2: ESA's optical high-resolution mission for GMES operational services, Remote Sensing of Environment 120 "
           "(2012) 25-36, doi:10.1016/j.rse.2011.11.026: required signal-to-noise ratios at reference radiances; aperture of 150 mm.", FIGURES)],
         [*around_centre(MSI, 1e-3), told("optics", {"aperture": "150 mm", "f_number": 4})]),
        ("Sentinel-3 OLCI", "OLCI", "Ocean and land colour from 814 km. Nominal centres and widths (Oa21 is two thirds as wide); the noise is what was required at radiances of the open ocean.",
         "300 m",
         [("C. Donlon et al., The Global Monitoring for Environment and Security (GMES) Sentinel-3 mission, Remote Sensing of Environment 120 "
           "(2012) 37-57, doi:10.1016/j.rse.2011.07.024: bands, reference radiances, required signal-to-noise ratios.", FIGURES)],
         [*around_centre(OLCI, 1e-3)]),
        ("Sentinel-3 SLSTR", "SLSTR",
         "Two views, conical, from 814 km; one is told. Nominal centres and widths; noise of S7 to S9 as required at 270 K, none is told of S1 to S6.",
         "500 m (S1 to S6), 1 km",
         [("European Space Agency, Sentinel-3 SLSTR user guide (2016), radiometric resolution, table 1.", FIGURES),
          ("C. Donlon et al., The Global Monitoring for Environment and Security (GMES) Sentinel-3 mission, Remote Sensing of Environment 120 "
           "(2012) 37-57, doi:10.1016/j.rse.2011.07.024: NEdT at 270 K.", FIGURES)], around_centre(SLSTR)),
    ],
    "nasa": [
        ("MODIS", "Terra MODIS; Aqua MODIS", "Whiskbroom of Terra and Aqua, from 705 km. Nominal edges (6, 7 and 12 of Terra's lie a third to half a width shorter); the noise is what was required "
         "at typical radiances.", "1 km (bands 8 to 36), 250 m (1, 2), 500 m (3 to 7)", [MODIS_PAGE], [*bands(MODIS, 1e-3), *bands(MODIS_THERMAL)]),
        ("ASTER", "Terra ASTER", "Three telescopes on Terra, from 705 km. Nominal edges; noise of 10 to 14 as required at 300 K; of 1 to 9 it is told in reflectance, not "
         "in radiance, and left out. Band 3B, which looks back, is as 3N.", "15 m (1 to 3N), 30 m (4 to 9), 90 m (10 to 14)",
         [("M. Abrams, S. Hook, B. Ramachandran, ASTER User Handbook, version 2, Jet Propulsion Laboratory (2002), table of bands.", PUBLIC),
          ("Y. Yamaguchi, A. B. Kahle, H. Tsu, T. Kawakami, M. Pniel, Overview of Advanced Spaceborne Thermal Emission and Reflection Radiometer "
           "(ASTER), IEEE Transactions on Geoscience and Remote Sensing 36 (1998) 1062-1071, doi:10.1109/36.700991: NEdT of 0.3 K or less.", FIGURES)],
         bands(ASTER)),
        ("VIIRS", "Suomi NPP VIIRS; NOAA-20 VIIRS", "Whiskbroom of Suomi NPP and its followers, from 829 km. Nominal edges; the noise is what was required at typical "
         "radiances and temperatures, of bands with two gains at the high one. Of the day-night band none is told. M12 lies a third of its width shorter.", "750 m, I1 to I5 375 m",
         [("C. Cao, F. J. De Luccia, X. Xiong, R. Wolfe, F. Weng, Early on-orbit performance of the Visible Infrared Imaging Radiometer Suite onboard "
           "the Suomi National Polar-Orbiting Partnership (S-NPP) satellite, IEEE Transactions on Geoscience and Remote Sensing 52 (2014) 1142-1156, "
           "doi:10.1109/TGRS.2013.2247768: bands, typical radiances, required SNR and NEdT.", FIGURES)], bands(VIIRS)),
        ("ECOSTRESS", "PHyTIR", "Thermal whiskbroom on the International Space Station, some 400 km up. Centres and widths of the five thermal bands as built; the sixth, at 1.6 um, "
         "finds clouds and is left out. No noise is told.", "70 m",
         [("S. J. Hook et al., In-flight validation of the ECOSTRESS, Landsats 7 and 8 thermal infrared spectral channels using the Lake Tahoe CA/NV and "
           "Salton Sea CA automated validation sites, IEEE Transactions on Geoscience and Remote Sensing 58 (2020) 1294-1302, "
           "doi:10.1109/TGRS.2019.2945701.", FIGURES)], around_centre(ECOSTRESS)),
    ],
    "commercial": [
        ("WorldView-3", "WV-3; WorldView", "Panchromatic, eight bands to 1.04 um, eight of shortwave infrared, from 617 km. Nominal edges (half of NIR2's response lies in half of them); no noise is told.",
         "1.24 m, PAN 0.31 m, SWIR1 to SWIR8 3.7 m",
         [("DigitalGlobe, WorldView-3 data sheet (2014); the same edges in the International Charter's description of the mission "
           "(docs.charter.uat.esaportal.eu/missions/opt/worldview-3).", FIGURES)], bands(WORLDVIEW_3, 1e-3)),
        ("PlanetScope SuperDove", "SuperDove; PlanetScope", "Many small satellites some 500 km up, each a frame under stripes of filters (PSB.SD). Nominal edges; no noise is told.",
         "3.7 m",
         [("Planet Labs, PlanetScope 8-band asset: band order, wavelengths and metadata (support.planet.com, 2021).", FIGURES)], bands(SUPERDOVE, 1e-3)),
    ],
    "spectrometers": [
        ("EnMAP", "EnMAP HSI", "Two spectrometers of prisms, 653 km up: 91 channels, then 133 that begin at 0.9 um. Centres within 0.5 nm, widths the mean resolution of each of the two "
         "(6.5 and 10 nm; a channel's own differs by up to a quarter). Required were ratios of 500 at 495 nm and 150 at 2200 nm under reflectance 0.3, the Sun at 30 deg; "
         "in radiance no noise is told.", "30 m",
         [("EnMAP HSI instrument specification, OHB System and German Aerospace Center (2022): sampling, f/3, 522.4 mm, 174 mm, 9.5 arc seconds, 4.4 ms, 653 km.", FIGURES),
          ("L. Guanter et al., The EnMAP spaceborne imaging spectroscopy mission for Earth observation, Remote Sensing 7 (2015) 8830-8857, "
           "doi:10.3390/rs70708830.", FIGURES),
          ("German Aerospace Center, centres of the channels of EnMAP's products (2022), as programs that read them have them.", FIGURES)],
         [*series(ENMAP_VNIR, 6.5), *series(ENMAP_SWIR, 10.0), *pushbroom("522.4 mm", "24 um", "4.4 ms", 653e3, 6820), told("optics", {"f_number": 3})]),
        ("PRISMA", "PRISMA HYC", "Two spectrometers of prisms, 615 km up: 63 and 167 channels of its products. Centres within 0.5 nm, widths the 12 nm that none was to exceed (they are 9 to "
         "15). Published ratios (200 or more below 1.75 um, 100 beyond 1.95 um) come without radiances; no noise is told.", "30 m",
         [("Italian Space Agency, PRISMA products specification (2020): two channels, resolution of 12 nm or less; centres of the channels of its level 2 "
           "products, as programs that read them have them.", FIGURES)],
         [*series(PRISMA_VNIR, 12.0), *series(PRISMA_SWIR, 12.0)]),
        ("EMIT", "", "Dyson spectrometer at f/1.8 on the International Space Station, some 400 km up. Centres within 0.5 nm, widths 8.5 nm. Noise by JPL's model at the radiance of "
         "reflectance 0.3 under the Sun at 45 deg without air, straight lines between 17 wavelengths.", "60 m",
         [("NASA Land Processes DAAC, EMIT L1B at-sensor calibrated radiance, version 1 (2022): 285 channels from 381 to 2493 nm.", PUBLIC),
          ("R. O. Green et al., The Earth Surface Mineral Dust Source Investigation: an Earth science imaging spectroscopy mission, 2020 IEEE Aerospace "
           "Conference, 1-15, doi:10.1109/AERO47225.2020.9172731.", FIGURES),
          isofit("emit_noise.txt", "centres and noise")],
         [*series(through(EMIT), 8.5), noise_under_sun(EMIT_NOISE), told("optics", {"f_number": 1.8})]),
        ("DESIS", "", "Offner spectrometer at f/2.8 on the International Space Station, some 400 km up. Equal steps of 2.55 nm, widths 3.5 nm. A ratio of 195 at 550 nm is published without a "
         "radiance; no noise is told.", "30 m",
         [("German Aerospace Center, DESIS, instrument (dlr.de, 2018): 235 channels from 402 to 1000 nm, sampled at 2.55 nm.", FIGURES),
          ("K. Alonso et al., Data products, quality and validation of the DLR Earth Sensing Imaging Spectrometer (DESIS), Sensors 19 (2019) 4471, "
           "doi:10.3390/s19204471: widths.", FIGURES)],
         ["series: 0.402 1 235 0.0035", told("optics", {"f_number": 2.8})]),
        ("AVIRIS-NG", "AVIRIS", "Dyson spectrometer on aircraft. Equal steps of 5 nm as published, and widths as the steps (measured they are 5.6 to 6 nm). Pixels as an aircraft's height has them; "
         "5 m are of 5 km at 1 mrad. Noise by JPL's model at the radiance of reflectance 0.3 under the Sun at 45 deg without air, straight lines between 20 wavelengths.", "5 m",
         [("Jet Propulsion Laboratory, AVIRIS-NG distribution document (2017): intervals of 5 nm from 380 to 2510 nm.", PUBLIC),
          ("J. W. Chapman et al., Spectral and radiometric calibration of the next generation Airborne Visible Infrared Spectrometer (AVIRIS-NG), Remote Sensing 11 "
           "(2019) 2129, doi:10.3390/rs11182129.", FIGURES),
          isofit("avirisng_noise.txt", "noise")],
         ["series: 0.38 2.51 427 0.005", noise_under_sun(AVIRIS_NG_NOISE)]),
        ("HyTES", "", "Thermal Dyson spectrometer on aircraft. Equal steps and widths as these (17.6 nm); no other width was found. Pixels of 5 to 50 m as an aircraft's height has them. Noise "
         "from JPL's model, straight lines between 27 wavelengths.", "10 m",
         [("Oak Ridge National Laboratory DAAC, HyTES (github.com/ornldaac/airborne, 2024): 256 channels between 7.5 and 12 um, 512 pixels.", PUBLIC),
          isofit("joint_avirisc_noise_223_hytes_parametric_noise_model.txt", "spacing and noise")],
         ["series: 7.5 12 256 0.0176", noise((nm, 10.0 * radiance) for nm, radiance in HYTES_NOISE)]),
    ],
    "cameras": [
        ("FLIR A65", "microbolometer; 640 x 512 microbolometer; LWIR camera", "Uncooled microbolometer of 640 x 512 elements of 17 um behind 13 mm at f/1.25; less than 0.05 K, as a typical "
         "figure for all of its range as one band. Each element takes 12 ms to follow. Position is a suggestion.", "microbolometer, 640 x 512",
         [("FLIR Systems, User's manual FLIR Ax5 series, T559770 (2014), technical data of the FLIR A65, 13 mm.", FIGURES)],
         ["band: LWIR from 7.5 13 nedt 0.05 300", told("optics", {"f_number": 1.25}), told("detector", {"time_constant": "12 ms", "frame_period": "33.33 ms"}),
          frame("13 mm", "17 um", [640, 512])]),
        ("FLIR Boson 640", "Boson 640; Boson", "Uncooled microbolometer of 640 x 512 elements of 12 um, 60 frames a second; 0.04 K at f/1.0, the best of its grades. Its time constant was not "
         "found. The lens, of 14 mm, is one of several; position is a suggestion.", "microbolometer, 640 x 512",
         [("FLIR Systems, Boson thermal imaging core, data sheet 102-2013-40, release 340 (2021): array, NEdT, frame rate.", FIGURES),
          ("GroupGets, spectral response of FLIR's microbolometers (groupgets.com, 2020): 7.5 to 13.5 um.", FIGURES)],
         ["band: LWIR from 7.5 13.5 nedt 0.04 300", told("optics", {"f_number": 1.0}), frame("14 mm", "12 um", [640, 512])]),
        ("FLIR A6700sc", "cooled MWIR camera; MWIR camera; A6700", "Cooled camera of 640 x 512 elements of indium antimonide, 15 um, 3 to 5 um, f/2.5, 14 bits, 60 frames a second; 0.02 K as specified (0.018 K "
         "is typical). Well, reading noise and efficiency are not told. The lens, of 50 mm, is one of several; position is a suggestion.", "cooled MWIR camera, 640 x 512",
         [("FLIR Systems, A6700sc MWIR, data sheet (2014).", FIGURES)],
         ["band: MWIR from 3 5 nedt 0.02 300", told("optics", {"f_number": 2.5}), frame("50 mm", "15 um", [640, 512])]),
        ("Nikon D700", "DSLR; D700; Nikon D3", "Single-lens reflex camera, 4256 x 2832 elements of 8.46 um under a Bayer pattern, at ISO 200 and 14 bits. Bells where its measured curves are half of their peaks. Well, gain "
         "and reading noise as measured of the Nikon D3, whose sensor it has. Efficiencies are no measurement: they follow from the well, the curves and the speed by ISO 12232 in light of CIE D65, and are "
         "upper limits, as cameras are filled by more light than their speed says. f/8, 1/1000 s, 50 mm and position are a suggestion for sunlight.", "DSLR, red, green and blue under a mosaic",
         [("J. Jiang, D. Liu, J. Gu, S. Suesstrunk, What is the space of spectral sensitivity functions for digital color cameras?, IEEE Workshop on Applications of Computer Vision (2013) 168-179, "
           "doi:10.1109/WACV.2013.6475015, and its database: curves of the D700.", FIGURES),
          ("P. Facey, Nikon D3 summary of findings (brisk.org.uk, 2008): well of 65,600 electrons, 4.1 electrons a count and reading noise of 4.3 counts at ISO 200.", FIGURES)],
         [*dslr(), told("optics", {"f_number": 8}),
          told("detector", {"pitch": f"{DSLR_PITCH_M * 1e6:.4g} um", "integration_time": "1 ms", "read_noise": "17.6 e-", "full_well": f"{DSLR_WELL} e-", "bits": 14,
                            "gain": "4.1 e-/count", "reference": {"reflectance": 0.3, "sun_zenith": "45 deg"}}),
          told("mosaic", [["red", "green"], ["green", "blue"]]), frame("50 mm", f"{DSLR_PITCH_M * 1e6:.4g} um", [640, 426])]),
    ],
}


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for group, sensors in GROUPS.items():
        text = HEAD
        for name, also, about, ground, sources, figures in sensors:
            text += f"\nsensor: {name}\n" + (f"also: {also}\n" if also else "") + f"about: {about}\nground: {ground}\n"
            text += "".join(f"source: {source} Licence: {licence}.\n" for source, licence in sources)
            text += "".join(f"{figure}\n" for figure in figures)
        (folder / f"{group}.txt").write_text(text)


if __name__ == "__main__":
    main()
