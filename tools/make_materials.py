#!/usr/bin/env python3
"""Makes data/materials/*.txt, the embedded spectral library, from published spectra that anyone may pass on.

    tools/make_materials.py SPECTRA INDICES PROSPECT_D data/materials

SPECTRA: a folder with `usgs7/` (files of the USGS Spectral Library Version 7) and `open/slum-london/` (the two tables of
SLUM London). INDICES: files of the refractiveindex.info database, as BOOK_PAGE.yml. PROSPECT_D: the coefficients of
PROSPECT-D, dataSpec_PDB as text. What is taken from where stands in tools/material_tables/catalogue*.py;
docs/formats/data.md describes the result. Needs numpy and PyYAML.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
from material_tables import grid, indices, metals, models, prospect, samples  # noqa: E402
from material_tables.catalogue import DRY, DONORS, SOIL  # noqa: E402
from material_tables.catalogue_built import CONSTRUCTION, METAL, ROOF  # noqa: E402
from material_tables.catalogue_nature import SOIL_GROUP, VEGETATION, WATER  # noqa: E402
from material_tables.sources import SOURCES  # noqa: E402

GROUPS = {"vegetation": VEGETATION, "soil": SOIL_GROUP, "water": WATER, "construction": CONSTRUCTION, "roof": ROOF,
          "metal": METAL}
TRANSMITTANCE_ENDS_UM = (2.5, 2.6)
PANE_CM = 0.4
FINE_UM = np.geomspace(0.35, 14.0, 3000)


class Library:
    """What the recipes of the catalogue ask for."""

    def __init__(self, spectra, index_folder, coefficients_path):
        spectra, index_folder = Path(spectra), Path(index_folder)
        self.usgs = samples.Usgs(spectra / "usgs7")
        self.slum = samples.Slum(spectra / "open/slum-london")
        self.coefficients = prospect.Coefficients(coefficients_path)
        self.water_index = indices.Index(index_folder / "H2O_Hale.yml")
        self.ice_index = indices.Index(index_folder / "H2O_Warren-2008.yml")
        self.glass_index = indices.Index(index_folder / "soda-lime_Rubin-clear.yml", index_folder / "soda-lime_Rubin-IR.yml")
        self.figure = samples.figure
        self.donor = {name: recipe(self) for name, recipe in DONORS.items()}

    def water(self):
        return models.computed(FINE_UM, indices.face(self.water_index.at(FINE_UM)), "water, one face", ("hale",))

    def ice(self):
        return models.computed(FINE_UM, indices.face(self.ice_index.at(FINE_UM)), "ice, one face", ("warren",))

    def window(self):
        values = indices.pane(self.glass_index.at(FINE_UM), FINE_UM, PANE_CM)
        return models.computed(FINE_UM, values, "model, clear soda-lime glass, 4 mm", ("rubin",))

    def metal(self, name):
        return metals.polished_metal(name, FINE_UM)

    def pool(self):
        return models.pool(self.water_index, FINE_UM)

    def moist(self, name):
        return models.moist(self.usgs.sample(name), self.water_index, 0.01)

    def mixture(self, parts):
        return samples.mixture([(share, self.usgs.sample(name)) for share, name in parts])

    def leaf(self, parameters):
        reflectance, transmittance = prospect.run(self.coefficients, parameters)
        sample = models.computed(self.coefficients.wavelength_um, reflectance, "model, " + contents(parameters), ("prospect",))
        sample.transmittance = self.transmittance(parameters)
        return sample

    def canopy(self, parameters, area, shade, dry):
        leaf = (self.coefficients.wavelength_um, *prospect.run(self.coefficients, parameters))
        title = (f"model, leaf area {area:g}, {dry:.0%} dry parts, {shade:.0%} in shade, leaves with {contents(parameters)}, "
                 "over rangeland soil")
        return models.canopy(leaf, area, self.usgs.sample(SOIL), self.usgs.sample(DRY), dry, shade, title)

    def quartz_sand(self):
        whole = self.usgs.joined("Quartz_GDS74_Sand_Ottawa_BECK", "Quartz_GDS74_Sand_Ottawa_NIC4")
        return samples.levelled(whole, 0.095, "sutherland",
                                "quartz sand (USGS), beyond 5 um at the emissivity of sands, 0.905 (8 to 14 um)")

    def transmittance(self, parameters):
        """On the grid: the model's within its range, its first value below, nothing beyond TRANSMITTANCE_ENDS_UM."""
        x, t = self.coefficients.wavelength_um, prospect.run(self.coefficients, parameters)[1]
        return np.interp(grid.wavelengths_um(), np.append(x, TRANSMITTANCE_ENDS_UM[1]), np.append(t, 0.0))


def contents(parameters):
    return ", ".join(f"{k} {v:.3g}" for k, v in zip(prospect.PARAMETERS, parameters))


def block(library, grid_um, curve):
    """The lines of one curve, and the keys of its sources."""
    sample = curve.recipe(library)
    donor = library.donor[curve.donor] if curve.donor else None
    x, y, ranges = grid.completed(grid_um, sample, donor)
    figures = grid.on_grid(grid_um, x, y)
    notes, used = list(curve.notes), list(sample.sources)
    transmittance = getattr(sample, "transmittance", None)
    if curve.leaf:
        parameters, rms = prospect.fit(library.coefficients, sample.wavelength_um, sample.reflectance)
        transmittance = library.transmittance(parameters)
        used.append("prospect")
        notes.append(f"transmittance by PROSPECT-D, {contents(parameters)}, whose reflectance differs by {rms:.3f} RMS from "
                     "the measured one")
    if transmittance is not None:
        transmittance = np.minimum(transmittance, 1.0 - figures)
        notes.append("transmittance 0 beyond 2.6 um, the value at 0.4 um below")
    if donor is not None and any(donor.title in how for _, _, how in ranges):
        used += [key for key in donor.sources if key not in used]
    error = grid.difference(grid_um, figures, sample)
    lines = [f"curve: {curve.name}", f"sample: {sample.title}", "source: " + " ".join(used),
             f"{'modelled' if sample.modelled else 'measured'}: {max(sample.first_um, grid_um[0]):.4g} "
             f"{min(sample.last_um, grid_um[-1]):.4g}"]
    lines += [f"not measured: {a:.4g} {b:.4g} {how}" for a, b, how in ranges]
    lines += [f"note: {note}" for note in notes]
    lines += [f"difference: {error[0]:.4f} {error[1]:.4f}", "reflectance: " + numbers(figures)]
    if transmittance is not None:
        lines.append("transmittance: " + numbers(np.trim_zeros(np.round(transmittance * 1e4), "b") * 1e-4))
    return lines, used


def numbers(values):
    return " ".join(f"{round(v * 1e4):d}" for v in values)


def main(spectra, index_folder, coefficients_path, target):
    library, grid_um = Library(spectra, index_folder, coefficients_path), grid.wavelengths_um()
    for group, materials in GROUPS.items():
        blocks, used = [], set()
        for material in materials:
            lines = [f"material: {material.name}", f"words: {group} {material.words}", f"about: {material.about}"]
            if material.instead_of:
                lines.append("instead of: " + "; ".join(material.instead_of))
            for curve in material.curves:
                more, keys = block(library, grid_um, curve)
                lines += more
                used |= set(keys)
            blocks.append("\n".join(lines))
        head = ["# Spectral library: directional-hemispherical reflectance and transmittance, in units of 1e-4, at the wavelengths",
                "# of `grid` (first, step, last in um, pieces that continue each other). Made by tools/make_materials.py;",
                "# docs/formats/data.md describes the format.",
                "grid: " + " ".join(f"{a:g} {s:g} {b:g}" for a, s, b in grid.PIECES)]
        head += [f"origin: {key} {SOURCES[key]}" for key in SOURCES if key in used]
        Path(target, f"{group}.txt").write_text("\n".join(head) + "\n\n" + "\n\n".join(blocks) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
