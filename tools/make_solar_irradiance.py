#!/usr/bin/env python3
"""Makes data/solar_irradiance.csv from the published spectra it is compiled from.

    tools/make_solar_irradiance.py HSRS.txt[.bz2] E490.dat > data/solar_irradiance.csv

HSRS.txt: the TSIS-1 Hybrid Solar Reference Spectrum at 1 nm resolution: wavelength in nm and irradiance in
mW m-2 nm-1, steps of 0.1 nm. E490.dat: ASTM E490-00a: wavelength in um and irradiance in W m-2 um-1.
"""
import bz2
import math
import sys

STEP_NM = 0.5
JOIN_UM = 2.73
OVERLAP_UM = (2.6, 2.73)
LOG_STEP = 0.02


def read_pairs(path):
    opener = bz2.open if path.endswith(".bz2") else open
    with opener(path, "rt") as lines:
        rows = [line.split()[:2] for line in lines if line.strip() and not line.startswith("#")]
    return [(float(x), float(y)) for x, y in rows]


def value_at(pairs, x):
    for (x0, y0), (x1, y1) in zip(pairs, pairs[1:]):
        if x0 <= x <= x1:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    raise ValueError(f"{x} is outside")


def integral(pairs, first=0.0, last=math.inf):
    rows = [(x, y) for x, y in pairs if first <= x <= last]
    return sum(0.5 * (y0 + y1) * (x1 - x0) for (x0, y0), (x1, y1) in zip(rows, rows[1:]))


def thinned(hsrs):
    """Points STEP_NM apart, each the mean over its surroundings, so that integrals stay."""
    every = round(STEP_NM / 0.1)
    weight = [every - abs(k) for k in range(-every + 1, every)]
    rows = []
    for i in range(0, len(hsrs), every):
        near = [(w, hsrs[j][1]) for w, j in zip(weight, range(i - every + 1, i + every)) if 0 <= j < len(hsrs)]
        if 0 < i < len(hsrs) - 1:
            rows.append((hsrs[i][0] / 1e3, sum(w * y for w, y in near) / sum(w for w, _ in near)))
        else:
            rows.append((hsrs[i][0] / 1e3, hsrs[i][1]))
    return rows


def main(hsrs_path, e490_path):
    hsrs = thinned(read_pairs(hsrs_path))
    e490 = read_pairs(e490_path)
    scale = integral(hsrs, *OVERLAP_UM) / integral(
        [(x, value_at(e490, x)) for x, _ in hsrs if OVERLAP_UM[0] <= x <= OVERLAP_UM[1]])
    tail = []
    for (x0, y0), (x1, y1) in zip(e490, e490[1:]):
        if x0 <= JOIN_UM:
            continue
        steps = math.ceil(math.log(x1 / x0) / LOG_STEP)
        for k in range(steps):
            share = k / steps
            tail.append((x0 * (x1 / x0) ** share, scale * y0 * (y1 / y0) ** share))
    tail.append((e490[-1][0], scale * e490[-1][1]))
    rows = hsrs + tail
    print("# Extraterrestrial solar spectral irradiance at 1 au.")
    print("# Columns: wavelength_um, irradiance_w_m2_um. Linear between points; nothing outside.")
    print("# 0.202 to 2.73 um: TSIS-1 Hybrid Solar Reference Spectrum (HSRS), 1 nm resolution, means at 0.5 nm.")
    print("#   O. M. Coddington et al., \"The TSIS-1 Hybrid Solar Reference Spectrum\", Geophysical Research Letters 48,")
    print("#   e2020GL091709 (2021), doi:10.1029/2020GL091709; LASP, University of Colorado, for NASA. Free to use with")
    print("#   citation.")
    print("# above 2.73 um: ASTM E490-00a (2006), Standard Solar Constant and Zero Air Mass Solar Spectral Irradiance")
    print(f"#   Tables, times {scale:.5f} so that it meets HSRS between 2.6 and 2.73 um; log-log interpolated to steps of 2 %.")
    print(f"# Integral: {integral(rows):.2f} W m-2 (of which {integral(hsrs):.2f} up to 2.73 um).")
    print("# Made by tools/make_solar_irradiance.py.")
    print("wavelength_um,irradiance_w_m2_um")
    for x, y in rows:
        print(f"{x:.6g},{y:.5g}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
