#!/usr/bin/env python3
"""Makes data/refractive_indices.txt from files of the refractiveindex.info database.

    tools/make_refractive_indices.py FOLDER > data/refractive_indices.txt

FOLDER: its files under the names BOOK_PAGE.yml (Au_Olmon-ev.yml for main/Au/Olmon-ev.yml). What lies outside 0.2 to 60 um is left out, and
of the rest the points between which n and k are straight within a thousandth of n + ik.
"""
import html
import pathlib
import re
import sys

FIRST_UM, LAST_UM = 0.2, 60.0
WITHIN = 1e-3

# Name, what it is, files that continue each other.
CATALOGUE = [
    ("aluminium", "evaporated films, without their oxide", ["Al_Rakic"]),
    ("chromium", "films; model of Brendel and Bormann", ["Cr_Rakic-BB"]),
    ("copper", "metal", ["Cu_Hagemann"]),
    ("gold", "evaporated film", ["Au_Olmon-ev"]),
    ("iron", "metal", ["Fe_Querry"]),
    ("lead", "metal", ["Pb_Ordal"]),
    ("nickel", "films; model of Brendel and Bormann, beyond 6.2 um measured", ["Ni_Rakic-BB", "Ni_Ordal"]),
    ("platinum", "films; model of Brendel and Bormann", ["Pt_Rakic-BB"]),
    ("silver", "metal", ["Ag_Hagemann"]),
    ("titanium", "films; model of Brendel and Bormann", ["Ti_Rakic-BB"]),
    ("tungsten", "films; model of Brendel and Bormann, beyond 12.4 um measured", ["W_Rakic-BB", "W_Ordal"]),
    ("zinc", "metal", ["Zn_Querry"]),
    ("water", "pure, 25 degC", ["H2O_Hale"]),
    ("ice", "-7 degC", ["H2O_Warren-2008"]),
    ("glass, soda-lime", "clear window glass", ["soda-lime_Rubin-clear", "soda-lime_Rubin-IR"]),
    ("silica, fused", "amorphous; below 6.7 um as if it did not absorb", ["SiO2_Malitson", "SiO2_Popova"]),
    ("alumina", "oxidised mirror of aluminium", ["Al2O3_Querry"]),
    ("gypsum", "crystal, along alpha", ["CaSO4_Querry-alpha"]),
    ("haematite", "crystal, ordinary ray", ["Fe2O3_Querry-o"]),
    ("graphite", "pellet of powder (Dixon KS-2)", ["C_Querry-DixonKS2"]),
    ("salt", "sodium chloride", ["NaCl_Querry"]),
    ("silicon", "crystal (float zone), 25 degC", ["Si_Franta-25C"]),
    ("germanium", "film", ["Ge_Amotchkina"]),
    ("titanium dioxide", "film, atomic layer deposition", ["TiO2_Siefke"]),
    ("zinc oxide", "pellet", ["ZnO_Querry"]),
    ("zinc selenide", "window material", ["ZnSe_Querry"]),
]

HEAD = f"""\
# Complex refractive indices n + ik, k > 0 where light is absorbed, from {FIRST_UM:g} to {LAST_UM:g} um where they were measured.
# Source: refractiveindex.info database (M. N. Polyanskiy, Scientific Data 11 (2024) 94), and the publication named beside each.
# Licence: CC0 1.0 (the database's own). Made by tools/make_refractive_indices.py, which leaves points out
# between which n and k are straight within {WITHIN:g} of |n + ik|.
# A line "index: NAME" opens one; "about" is what was measured; below it rows of wavelength (um), n and k."""


def section(text, key):
    found = re.search(rf"^{key}: ?\|?\n?((?:[ ].*\n|\n)+|.*\n)", text, re.MULTILINE)
    return found.group(1)


def publication(text):
    plain = html.unescape(re.sub(r"<[^>]+>", "", section(text, "REFERENCES").split("<br>")[0]))
    plain = re.sub(r"^1\) |\[\w+\]|, as cited in Ref\. 2| \([^()]*(kindly|See Supp)[^()]*\)", "", " ".join(plain.split()))
    return plain.strip()


def numbers(lines):
    return [[float(word) for word in line.split()] for line in lines.splitlines() if line.strip()]


def tabulated(text, kind):
    found = re.search(rf"type: tabulated {kind}\n\s+data: \|\n((?:\s+[-\d.].*\n?)+)", text)
    return numbers(found.group(1)) if found else None


def formula(text):
    """n by wavelength of dispersion formulas 1 (Sellmeier) and 5 (Cauchy) of the database."""
    kind = int(re.search(r"type: formula (\d)", text).group(1))
    first, last = (float(word) for word in re.search(r"wavelength_range: (.*)", text).group(1).split())
    c = [float(word) for word in re.search(r"coefficients: (.*)", text).group(1).split()]

    def n(um):
        pairs = list(zip(c[1::2], c[2::2]))
        if kind == 1:
            return (1 + c[0] + sum(a * um**2 / (um**2 - b**2) for a, b in pairs)) ** 0.5
        if kind == 5:
            return c[0] + sum(a * um**b for a, b in pairs)
        raise ValueError(f"formula {kind}")

    return n, first, last


def rows_of(text):
    both = tabulated(text, "nk")
    if both:
        return [(um, n, max(0.0, k)) for um, n, k in both]
    n, first, last = formula(text)
    k = tabulated(text, "k")
    if k:
        return [(um, n(um), max(0.0, value)) for um, value in k]
    steps = 400
    return [(um, n(um), 0.0) for um in (first * (last / first) ** (i / steps) for i in range(steps + 1))]


def thinned(rows):
    """Greedily the longest straight pieces."""
    kept, start = [rows[0]], 0
    while start < len(rows) - 1:
        end = start + 1
        while end + 1 < len(rows) and is_straight(rows[start : end + 2]):
            end += 1
        kept.append(rows[end])
        start = end
    return kept


def is_straight(rows):
    (x0, n0, k0), (x1, n1, k1) = rows[0], rows[-1]
    for x, n, k in rows[1:-1]:
        t = (x - x0) / (x1 - x0)
        if abs(complex(n0 + t * (n1 - n0) - n, k0 + t * (k1 - k0) - k)) > WITHIN * abs(complex(n, k)):
            return False
    return True


def main(folder):
    print(HEAD)
    for name, about, files in CATALOGUE:
        rows, sources = [], []
        for file in files:
            text = (pathlib.Path(folder) / f"{file}.yml").read_text()
            last = rows[-1][0] if rows else 0.0
            by_um = {row[0]: row for row in rows_of(text) if FIRST_UM <= row[0] <= LAST_UM and row[0] > last}
            rows += sorted(by_um.values())  # a few stand twice, or not in order
            source = publication(text)
            if source not in sources:
                sources.append(source)
        print(f"\nindex: {name}\nabout: {about}")
        for source in sources:
            print(f"source: {source}")
        for um, n, k in thinned(rows):
            print(f"{um:.5g} {n:.5g} {k:.4g}")


if __name__ == "__main__":
    main(sys.argv[1])
