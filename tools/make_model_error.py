#!/usr/bin/env python3
"""Makes data/atmosphere/model_error.txt, how far the model of the air may be off, of comparisons with programs that have
newer data (docs/theory/atmosphere_model_error.md):

    ifov study atmosphere --reference DIR --output OUT
    tools/make_model_error.py OUT/model_comparisons.csv

twice, because errors of emission are those beside what the depths' errors of the program's table make of it.

Only the cases marked 'make' enter the table; those marked 'test' are judged by it, and the figures are printed."""

import csv
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Windows and bands of absorption, um. Chosen by what absorbs, not by what was found.
EDGES = [0.2, 0.5, 0.66, 0.7, 0.74, 0.8, 0.86, 0.9, 0.99, 1.06, 1.2, 1.3, 1.5, 1.55, 1.72, 1.78, 2.1, 2.3, 2.5, 2.75,
         3.5, 3.7, 4.0, 4.2, 4.5, 4.8, 5.2, 8.0, 8.5, 9.2, 9.9, 10.2, 11.2, 12.1, 14.0, 50.0]
SHARE = 0.95          # of a row's figures of every case, to be covered
LEAST = 0.005         # transmittance below which the air hides what is behind it
ALONE = 1.25          # widens rows that are made of one case: what others would add (see leave_one_out)
NUMBERS = 0.005       # what a sum over levels is off by itself
MOST = 0.9            # as the program has it
MISSING = 0.04        # more than that no gas that the model lacks has in a vertical column outside the bands of others
FIGURES = ("wavelength_um", "air_mass", "water_g_cm2", "gas_depth", "haze_depth", "haze_share", "ours", "reference", "by_depth")


def rows_of(path):
    with open(path, newline="") as lines:
        rows = list(csv.DictReader(lines))
    for row in rows:
        row.update({key: float(row[key]) for key in FIGURES})
    return rows


def quantile(values):
    """The least value that SHARE of the values do not exceed."""
    ordered = np.sort(values)
    return float(ordered[min(len(ordered) - 1, int(np.ceil(SHARE * len(ordered))) - 1)]) if len(ordered) else 0.0


def depths(cases):
    """The narrowest `missing`, `wet` and `gas` with which SHARE of every case's figures lie within
    missing * air_mass + wet * water + gas * depth."""
    best = None
    for gas in np.arange(0.0, MOST + 0.001, 0.02):
        for wet in np.arange(0.0, 0.0101, 0.0005):
            missing = max(max(0.0, quantile((np.abs(d) - gas * depth - wet * water) / air))
                          for d, depth, air, water, _ in cases)
            if missing > MISSING and gas < MOST - 0.01:
                continue
            width = np.mean([np.mean(t * (missing * air + wet * water + gas * depth))
                             for _, depth, air, water, t in cases])
            if best is None or width < best[0] - 1e-9:
                best = (width, missing, wet, gas)
    return best[1:]


def cases_of(rows, first, last):
    """Of one row: by case differences of ln transmittance, gas depth, columns of air, water vapour, transmittance."""
    cases = []
    for name in sorted({row["case"] for row in rows}):
        chosen = [row for row in rows if row["case"] == name and row["quantity"] == "transmittance"
                  and first <= row["wavelength_um"] < last and min(row["ours"], row["reference"]) > LEAST]
        if len(chosen) < 4:
            continue
        ours, reference, depth, air, water = (
            np.array([row[key] for row in chosen])
            for key in ("ours", "reference", "gas_depth", "air_mass", "water_g_cm2"))
        cases.append((np.log(ours / reference), depth, air, water, ours))
    return cases


def leave_one_out(rows):
    """By what a row made of one case alone would have to be widened to hold SHARE of another's: the median."""
    factors = []
    for first, last in zip(EDGES, EDGES[1:]):
        cases = cases_of(rows, first, last)
        for i, one in enumerate(cases):
            missing, wet, gas = depths([one])
            for k, (d, depth, air, water, _) in enumerate(cases):
                if k != i:
                    stated = missing * air + wet * water + gas * depth
                    factors.append(quantile(np.abs(d) / np.maximum(stated, 1e-3)))
    return float(np.median(factors))


def absorption(rows):
    table = []
    for first, last in zip(EDGES, EDGES[1:]):
        cases = cases_of(rows, first, last)
        factor = ALONE if len(cases) == 1 else 1.0
        table.append(tuple(factor * value for value in depths(cases)) if cases else None)
    # Where no light came through in any case: as the worse of the rows beside it.
    for i, row in enumerate(table):
        if row is None:
            beside = [table[k] for k in (i - 1, i + 1) if 0 <= k < len(table) and table[k] is not None]
            table[i] = tuple(max(values) for values in zip(*beside))
    return table


def at(table, wavelength_um):
    return table[max(0, int(np.searchsorted(EDGES, wavelength_um, side="right")) - 1)] if wavelength_um < EDGES[-1] else table[-1]


def of_gases(table, row):
    missing, wet, gas = at(table, row["wavelength_um"])
    return missing * row["air_mass"] + wet * row["water_g_cm2"] + gas * row["gas_depth"]


def scattering(rows, table):
    """Relative errors of light scattered by molecules and by haze, and the least, as a reflectance."""
    chosen = [row for row in rows if row["quantity"] == "scattered"]
    relative, absolute = [], []
    for row in chosen:
        gases = np.expm1(of_gases(table, row))
        relative.append(max(0.0, abs(row["reference"] / row["ours"] - 1.0) - gases))
        absolute.append(abs(row["reference"] - row["ours"]))
    relative, absolute = np.array(relative), np.array(absolute)
    um, haze, depth = (np.array([row[key] for row in chosen]) for key in ("wavelength_um", "haze_share", "gas_depth"))
    molecules = quantile(relative[um < 0.7])
    hazy = quantile((np.maximum(0.0, relative - molecules * (1.0 - haze)) / haze)[(um >= 0.7) & (um < 1.3)])
    return molecules, hazy, quantile(absolute[(um >= 1.5) & (depth < 0.3)])


def emission(rows):
    """By row: what is emitted, relative, beside what errors of depths and numbers (half a percent) make of it."""
    table = []
    for first, last in zip(EDGES, EDGES[1:]):
        chosen = [row for row in rows if row["quantity"] == "emitted" and first <= row["wavelength_um"] < last]
        table.append(quantile([max(0.0, (abs(row["reference"] - row["ours"]) - row["by_depth"]) / row["ours"] - NUMBERS)
                               for row in chosen]) if chosen else None)
    known = [value for value in table if value is not None]
    return [known[0] if value is None else value for value in table]


def judge(rows, table, scattered, emitted):
    for name in sorted({row["case"] for row in rows}):
        for quantity in ("transmittance", "scattered", "emitted"):
            chosen = [row for row in rows if row["case"] == name and row["quantity"] == quantity]
            if not chosen:
                continue
            held = 0
            for row in chosen:
                error = np.expm1(of_gases(table, row) + scattered[1] * row["haze_depth"])
                stated = row["ours"] * error + 5e-5
                if quantity == "scattered":
                    haze = row["haze_share"]
                    stated = row["ours"] * (error + scattered[0] * (1.0 - haze) + scattered[1] * haze) + scattered[2]
                if quantity == "emitted":
                    stated = row["by_depth"] + (NUMBERS + at(emitted, row["wavelength_um"])) * row["ours"]
                held += abs(row["ours"] - row["reference"]) <= stated
            print(f"{name} ({chosen[0]['use']}), {quantity}: {held} of {len(chosen)}, {held / len(chosen):.3f}")


def main():
    rows = rows_of(sys.argv[1])
    makers = [row for row in rows if row["use"] == "make"]
    table = absorption(makers)
    molecules, haze, floor = scattering(makers, table)
    emitted = emission(makers)
    print(f"a row of one case holds {SHARE:.0%} of another's where it is widened by {leave_one_out(makers):.2f}")
    lines = ["# How far the model of the air may be off. Columns: first and last wavelength, um; optical depth of what",
             "# the model lacks, per vertical column of air and per g cm-2 of water vapour; of the gases' optical depth,",
             "# relative; of what molecules scatter, relative; of the aerosol's depth and what it scatters, relative; of",
             "# what the air emits, relative, beside what depths make of it; of scattered sunlight at least, as a reflectance.",
             "# Made by tools/make_model_error.py of differences from MODTRAN 6.0.2 (hazy run over Pasadena of isofit's",
             "# tutorials, Apache-2.0), MODTRAN5 (5 km at the ground, of pyradi, MIT) and REPTRAN of libRadtran (Gasteiger et",
             "# al. 2014): figures of our own, in the public domain (CC0). docs/theory/atmosphere_model_error.md.",
             "@model_error"]
    for (first, last), (missing, wet, gas), warm in zip(zip(EDGES, EDGES[1:]), table, emitted):
        lines.append(f"{first:g} {last:g}  {missing:.4f} {wet:.4f} {gas:.2f}  {molecules:.4f} {haze:.4f}  {warm:.3f}  {floor:.2g}")
    (ROOT / "data" / "atmosphere" / "model_error.txt").write_text("\n".join(lines) + "\n")
    judge(rows, table, (molecules, haze, floor), emitted)


if __name__ == "__main__":
    main()
