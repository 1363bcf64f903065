#!/usr/bin/env python3
"""Makes data/materials/*.txt, the embedded spectral library, from the published spectra that it is compiled from.

    tools/make_materials.py SPECTRA PROSPECT_D data/materials

SPECTRA: a folder with `ecostress/` and `aster-v2/` (files of these libraries) and `envi-sli/library_berlin.hdr` (the image
library of the Berlin-Urban-Gradient data set). PROSPECT_D: the coefficients of PROSPECT-D, dataSpec_PDB as text. What is
taken from where stands in tools/material_tables/catalogue.py; docs/formats/data.md describes the result. Needs numpy.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
from material_tables import grid, prospect, samples  # noqa: E402
from material_tables.catalogue import GROUPS, KIN  # noqa: E402

SOURCES = {
    "ecostress": "S. K. Meerdink et al., The ECOSTRESS spectral library version 1.0, Remote Sensing of Environment 230 "
                 "(2019) 111196; A. M. Baldridge et al., The ASTER spectral library version 2.0, Remote Sensing of "
                 "Environment 113 (2009) 711-715. Reproduced from the ECOSTRESS Spectral Library through the courtesy of the "
                 "Jet Propulsion Laboratory, California Institute of Technology, Pasadena, California. Copyright 2017, "
                 "California Institute of Technology, all rights reserved. Licence: none stated; the library asks for these "
                 "citations and this credit.",
    "berlin": "A. Okujeni, S. van der Linden, P. Hostert, Berlin-Urban-Gradient dataset 2009, GFZ Data Services (2016), "
              "doi:10.5880/enmap.2016.008: image endmember library (HyMap). Licence: see the data set's page; figures "
              "resampled, cite it.",
    "rakic": "A. D. Rakic et al., Applied Optics 37 (1998) 5271-5283, table 2 (Lorentz-Drude), and Fresnel's equation at "
             "normal incidence. Licence: computed here.",
    "prospect": "PROSPECT-D, J.-B. Feret et al., Remote Sensing of Environment 193 (2017) 204-215. Licence: computed here.",
}
TRANSMITTANCE_ENDS_UM = (2.5, 2.6)


class Maker:
    def __init__(self, folder, coefficients_path):
        self.folder = Path(folder)
        self.grid_um = grid.wavelengths_um()
        self.coefficients = prospect.Coefficients(coefficients_path)
        self.berlin = samples.spectral_library(self.folder / "envi-sli/library_berlin.hdr", 1e-4)
        self.kin = {name: self.ecostress(files) for name, files in KIN.items()}

    def ecostress(self, names):
        return samples.ecostress(self.folder / "ecostress", *names)

    def transmittance(self, parameters):
        """On the grid: the model's within its range, its first value below, nothing beyond TRANSMITTANCE_ENDS_UM."""
        x, t = self.coefficients.wavelength_um, prospect.run(self.coefficients, parameters)[1]
        return np.interp(self.grid_um, np.append(x, TRANSMITTANCE_ENDS_UM[1]), np.append(t, 0.0))

    def block(self, curve):
        """The lines of one curve."""
        lines, transmittance, notes = [f"curve: {curve.name}"], None, []
        if curve.prospect:
            source = "prospect"
            x = self.coefficients.wavelength_um
            sample = samples.Sample(x, prospect.run(self.coefficients, curve.prospect)[0], "PROSPECT-D")
            transmittance = self.transmittance(curve.prospect)
            title = "model, " + ", ".join(f"{k} {v:g}" for k, v in zip(prospect.PARAMETERS, curve.prospect))
        elif curve.metal:
            source, sample = "rakic", samples.polished_metal(curve.metal, np.geomspace(0.35, 14.0, 2000))
            title = "model, smooth surface"
        elif curve.berlin:
            source, sample = "berlin", self.berlin[curve.berlin]
            title = f"{curve.berlin}, image spectrum"
        elif curve.table:
            source, sample = "ecostress", samples.table(Path(__file__).parent / "material_tables" / curve.table)
            title = "Olive green gloss paint, sample 0385UUUPNT, Johns Hopkins University"
        else:
            source, sample = "ecostress", self.ecostress(curve.eco)
            title = sample.title
        x, y, ranges = grid.completed(self.grid_um, sample, self.kin.get(curve.kin))
        figures = grid.on_grid(self.grid_um, x, y)
        if curve.leaf:
            parameters, rms = prospect.fit(self.coefficients, sample.wavelength_um, sample.reflectance)
            transmittance = self.transmittance(parameters)
            notes.append("transmittance by PROSPECT-D, " +
                         ", ".join(f"{k} {v:.3g}" for k, v in zip(prospect.PARAMETERS, parameters)) +
                         f", whose reflectance differs by {rms:.3f} RMS from the measured one")
        if transmittance is not None:
            transmittance = np.minimum(transmittance, 1.0 - figures)
            notes.append("transmittance 0 beyond 2.6 um, the value at 0.4 um below")
        if sample.join_step:
            notes.append(f"visible and thermal halves joined at {sample.join_step[0]:g} um, where they differ by "
                         f"{sample.join_step[1]:+.3f}")
        error = grid.difference(self.grid_um, figures, sample)
        kind = "modelled" if source in ("prospect", "rakic") else "measured"
        lines += [f"sample: {title}", f"source: {source}",
                  f"{kind}: {max(sample.first_um, self.grid_um[0]):.4g} {min(sample.last_um, self.grid_um[-1]):.4g}"]
        lines += [f"not measured: {a:.4g} {b:.4g} {how}" for a, b, how in ranges]
        lines += [f"note: {note}" for note in notes]
        lines += [f"difference: {error[0]:.4f} {error[1]:.4f}", "reflectance: " + numbers(figures)]
        if transmittance is not None:
            lines.append("transmittance: " + numbers(np.trim_zeros(np.round(transmittance * 1e4), "b") * 1e-4))
        return lines


def numbers(values):
    return " ".join(f"{round(v * 1e4):d}" for v in values)


def main(folder, coefficients_path, target):
    maker = Maker(folder, coefficients_path)
    for group, materials in GROUPS.items():
        blocks, used = [], set()
        for material in materials:
            lines = [f"material: {material.name}", f"words: {group} {material.words}", f"about: {material.about}"]
            for curve in material.curves:
                lines += maker.block(curve)
            used |= {line.split(": ")[1] for line in lines if line.startswith("source: ")}
            blocks.append("\n".join(lines))
        head = ["# Spectral library: directional-hemispherical reflectance and transmittance, in units of 1e-4, at the wavelengths",
                "# of `grid` (first, step, last in um, pieces that continue each other). Made by tools/make_materials.py;",
                "# docs/formats/data.md describes the format.",
                "grid: " + " ".join(f"{a:g} {s:g} {b:g}" for a, s, b in grid.PIECES)]
        head += [f"origin: {key} {SOURCES[key]}" for key in SOURCES if key in used]
        Path(target, f"{group}.txt").write_text("\n".join(head) + "\n\n" + "\n\n".join(blocks) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
