#!/usr/bin/env python3
"""Makes data/atmosphere/*.txt from the LOWTRAN7 tables.

    tools/make_atmosphere.py TABLES data/atmosphere

TABLES holds the coefficients of LOWTRAN7 (revision 4.2, 1992) as CSV: table_band_params, table_band_cprime,
table_h2o_continuum, table_n2_continuum, table_o2_continuum_1395_1760, table_o3_uvvis, table_o3_hartley_huggins,
table_model_atmospheres, table_aerosols_shettle_fenn, table_aerosol_profiles, table_phase_functions and
table_phase_selector. The trace gases and the band of nitrogen dioxide come from
atmosphere_tables beside this script. The absorption
terms are computed here. Needs NumPy.
"""
import csv
import pathlib
import sys

import numpy as np

GASES = ["H2O", "CO2", "O3", "N2O", "CO", "CH4", "O2", "NH3", "NO", "NO2", "SO2"]
TERMS = (3, 5, 8)
LOWTRAN = """\
# LOWTRAN7: F. X. Kneizys et al., Users Guide to LOWTRAN 7, AFGL-TR-88-0177 (1988), revision 4.2 of 1992.
# US Air Force Geophysics Laboratory; public domain. Made by tools/make_atmosphere.py; format in docs/formats/data.md.
"""


def rows(path):
    with open(path) as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def write(path, about, sections):
    """Sections are (heading, values, how to print one, how many a line)."""
    with open(path, "w") as out:
        for line in about:
            out.write(f"# {line}\n")
        out.write(LOWTRAN)
        for heading, values, form, per_line in sections:
            out.write(f"@{heading}\n")
            for i in range(0, len(values), per_line):
                out.write(" ".join(form(v) for v in values[i : i + per_line]) + "\n")


def number(value):
    return f"{float(value):.6g}"


def bands(tables):
    value = {(int(row["nu_cm1"]), gas): row[gas] for row in rows(tables / "table_band_cprime.csv") for gas in GASES}
    for row in rows(tables / "table_band_params.csv"):
        first, last = int(row["nu_lo"]), int(row["nu_hi"])
        logs = [value.get((nu, row["gas"])) or "-10" for nu in range(first, last + 1, 5)]
        heading = f"band {row['gas']} {first} {last} {row['a']} {row['n_pressure']} {row['m_temperature']}"
        yield heading, [round(1e5 * float(c)) for c in logs], str, 16


def table(heading, path, columns):
    content = rows(path)
    keys = list(content[0])
    picked = [keys[i] for i in columns]
    return heading, [row[key] for row in content for key in picked], number, len(picked)


def continua(tables):
    yield table("H2O self296 self260 foreign296", tables / "table_h2o_continuum.csv", range(4))
    yield table("N2", tables / "table_n2_continuum.csv", range(2))
    yield table("O2 strength linear quadratic", tables / "table_o2_continuum_1395_1760.csv", range(4))
    yield table("O3_visible", tables / "table_o3_uvvis.csv", range(2))
    yield table("O3_ultraviolet c0 c1 c2", tables / "table_o3_hartley_huggins.csv", range(4))
    # Of JPL, not LOWTRAN7.
    falling = rows(pathlib.Path(__file__).parent / "atmosphere_tables" / "nitrogen_dioxide.csv")
    values = [v for row in reversed(falling) for v in (1e7 / float(row["wavelength_nm"]), row["at_220_K"], row["at_294_K"])]
    yield "NO2 cold warm", values, number, 3


def profiles(tables):
    trace = rows(pathlib.Path(__file__).parent / "atmosphere_tables" / "trace_gases.csv")
    names = {"midlat_summer": "mid-latitude summer", "midlat_winter": "mid-latitude winter",
             "us_standard_1976": "US standard 1976"}
    models = {}
    for row in rows(tables / "table_model_atmospheres.csv"):
        models.setdefault(row["model"], []).append(row)
    for model, levels in models.items():
        values = []
        for level, more in zip(levels, trace):
            assert float(level["z_km"]) == float(more["z_km"])
            values += [level["z_km"], level["p_mb"], level["T_K"]]
            values += [level[f"{gas}_ppmv"] if f"{gas}_ppmv" in level else more[f"{gas}_ppmv"] for gas in GASES]
        yield names.get(model, model.replace("_", " ")), values, number, 14


def aerosols(tables):
    kinds = {}
    for row in rows(tables / "table_aerosols_shettle_fenn.csv"):
        if not row["model"].startswith("cloud"):
            kinds.setdefault((row["model"], row["rh_percent"] or "0"), []).append(row)
    for (kind, humidity), content in kinds.items():
        columns = ("wavelength_um", "ext_norm550", "abs_norm550", "asymmetry")
        yield (f"optics {kind} {humidity}", [row[c] for row in content for c in columns], number, 8)
    heights = rows(tables / "table_aerosol_profiles.csv")
    for column in list(heights[0])[1:]:
        pairs = [(row["z_km"], row[column]) for row in heights if row[column] and float(row[column]) > 0]
        yield f"height {column}", [x for pair in pairs for x in pair], number, 16


def phase_functions(tables):
    content = rows(tables / "table_phase_functions.csv")
    degrees = [key for key in content[0] if key != "number"]
    yield "angles", degrees, number, 17
    for row in content:
        yield f"function {row['number']}", [row[key] for key in degrees], number, 17
    content = rows(tables / "table_phase_selector.csv")
    wavelengths = [key for key in content[0] if key not in ("model", "rh_percent")]
    yield "wavelengths", wavelengths, number, 27
    for row in content:
        if row["model"] != "oceanic":
            yield f"kind {row['model']} {row['rh_percent'] or '0'}", [row[key] for key in wavelengths], str, 27


def absorption_terms(a, count):
    """k and weights whose sum of w exp(-k x) is nearest to exp(-x^a) in the largest error over x = 1e-7 to 1e3:
    damped least squares, points weighted up where the error is large."""
    x = np.logspace(-7, 3, 501)
    target = np.exp(-(x**a))
    log_k = np.linspace(-2.2, 2.0 + 9 * (1 - a) * count / 5, count)
    weight = np.exp(-0.5 * log_k**2 / (2 + 6 * (1 - a))) + 0.02
    state = np.concatenate([log_k, np.log(weight)])
    point_weight = np.ones(len(x))

    def model(state):
        k, share = np.exp(state[:count]), np.exp(state[count:] - state[count:].max())
        w = share / share.sum()
        decay = np.exp(-np.outer(x, k))
        sum_ = decay @ w
        slope = np.hstack([-(x[:, None] * k) * decay * w, w * (decay - sum_[:, None])])
        return sum_, slope, k, w

    best, damping = (np.inf,), 1e-2
    value, slope, k, w = model(state)
    for step in range(3000):
        error = target - value
        normal = (slope * point_weight[:, None]).T @ slope
        gradient = (slope * point_weight[:, None]).T @ error
        while True:
            move = np.linalg.solve(normal + damping * np.diag(np.diag(normal) + 1e-12), gradient)
            move = np.clip(move, -0.5, 0.5)
            tried = model(state + move)
            if (point_weight * (target - tried[0]) ** 2).sum() <= (point_weight * error**2).sum() or damping > 1e8:
                break
            damping *= 4
        state = state + move
        (value, slope, k, w), damping = tried, max(damping / 3, 1e-9)
        largest = abs(target - value).max()
        if largest < best[0]:
            best = (largest, k.copy(), w.copy())
        if step > 60 and step % 6 == 0:
            point_weight *= (1e-3 + abs(target - value) / largest) ** 0.7
            point_weight = np.maximum(point_weight / point_weight.mean(), 1e-6)
    return best


def terms(tables):
    for a in sorted({row["a"] for row in rows(tables / "table_band_params.csv")}):
        for count in TERMS:
            largest, k, w = absorption_terms(float(a), count)
            order = np.argsort(k)
            values = [v for j in order for v in (k[j], w[j])]
            yield f"terms {a} {count} {largest:.2g}", values, lambda v: f"{v:.9g}", 16


def main(tables, out):
    tables, out = pathlib.Path(tables), pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    write(out / "gas_bands.txt", [
        "Band model of eleven gases: T = exp(-(10^C' W)^a), on a grid of 5 cm-1 at a resolution of 20 cm-1.",
        "@band GAS first_cm1 last_cm1 a n m, then C' times 1e5, one for each 5 cm-1."], bands(tables))
    write(out / "continua.txt", [
        "Continuous absorption; the first column is the wavenumber, cm-1. @NO2: 1e-20 cm2 per molecule at 220 and 294 K, of",
        "JPL Publication 06-2 (2006), figures by way of TUV-x (Apache-2.0); the others of"],
        continua(tables))
    write(out / "profiles.txt", [
        "Six model atmospheres. Columns: altitude km, pressure hPa, temperature K, then ppmv of",
        " ".join(GASES),
        "G. P. Anderson et al., AFGL-TR-86-0110 (1986), as in"], profiles(tables))
    write(out / "aerosols.txt", [
        "@optics TYPE relative_humidity_percent: wavelength um, extinction, absorption (both over extinction at 550 nm), asymmetry.",
        "@height NAME: altitude km, extinction km-1 at 550 nm, where it is not 0.",
        "E. P. Shettle and R. W. Fenn, AFGL-TR-79-0214 (1979), as in"], aerosols(tables))
    write(out / "phase_functions.txt", [
        "Phase functions of aerosol. @angles: scattering angles, degrees. @function NUMBER: values in sr-1 at them.",
        "@wavelengths: um. @kind TYPE relative_humidity_percent: the number of the function at each of them.",
        "Mie's for the aerosols of E. P. Shettle and R. W. Fenn, AFGL-TR-79-0214 (1979), as in"], phase_functions(tables))
    write(out / "absorption_terms.txt", [
        "@terms a count largest_error: k and w of exp(-x^a) = sum of w exp(-k x), for every exponent a of the band model.",
        "Computed by tools/make_atmosphere.py; largest_error over x = 1e-7 to 1e3. Exponents of"], terms(tables))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
