#!/usr/bin/env python3
"""Makes data/indices/*.txt from files of the refractiveindex.info database (CC0 1.0).

    tools/make_indices.py INDICES data/indices

INDICES holds the database's own files (YAML with one block "tabulated nk"), named as in TABLES. Figures stay as they are given there,
one row a wavelength; rows beyond the limits are left out.
"""
import pathlib
import sys

# Name of ours: their file, first and last wavelength in um, what it is, publication.
TABLES = {
    "ice": ("H2O_Warren-2008.yml", 0.19, 200.0, "Ice Ih at 266 K.",
            "S. G. Warren and R. E. Brandt, Optical constants of ice from the ultraviolet to the microwave: a revised "
            "compilation,\n# Journal of Geophysical Research 113, D14220 (2008)"),
    "water": ("H2O_Segelstein.yml", 0.19, 60.0, "Liquid water at 25 degC.",
              "D. J. Segelstein, The complex refractive index of water, M.S. thesis, University of Missouri, Kansas City (1981), which "
              "continues\n# G. M. Hale and M. R. Querry, Applied Optics 12, 555-563 (1973)"),
}


def rows(path):
    """Wavelength, n and k, as written."""
    inside = False
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[:2] == ["data:", "|"]:
            inside = True
        elif inside and len(words) == 3:
            yield words
        elif inside:
            return


def main(source, target):
    for name, (file, first, last, about, publication) in TABLES.items():
        kept = [row for row in rows(source / file) if first <= float(row[0]) <= last]
        text = [f"# {about} Complex index of refraction n + ik: wavelength um, n, k.",
                f"# {publication};",
                f"# {file} of the refractiveindex.info database. Licence: CC0 1.0. Made by tools/make_indices.py; format in "
                "docs/formats/data.md."]
        text += [f"{float(um):.6g} {float(n):.6g} {float(k):.6g}" for um, n, k in kept]
        (target / f"{name}.txt").write_text("\n".join(text) + "\n", encoding="utf-8")
        print(f"{name}: {len(kept)} wavelengths, {kept[0][0]} to {kept[-1][0]} um")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
