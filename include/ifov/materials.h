#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ifov/api.h"

namespace ifov {

/// A material of the library that is compiled in, with the spectra of its samples.
struct Material {
  struct Curve {
    std::string name;
    std::string sample;                    ///< what was measured or modelled
    std::vector<std::string> origins;      ///< publications and licences
    bool modelled = false;                 ///< else measured
    double first_um = 0.0, last_um = 0.0;  ///< of the measurement or the model
    std::vector<double> wavelength_um;
    std::vector<double> reflectance;    ///< directional-hemispherical, at each wavelength
    std::vector<double> transmittance;  ///< likewise, of a leaf; empty: opaque, or not known
    std::vector<double> emissivity;     ///< 1 - reflectance - transmittance
  };
  std::string name;  ///< "grass, lawn", as documents name it
  std::string group, about;
  std::vector<std::string> words;  ///< more words that it is found by
  std::vector<Curve> curves;
};

/// The material of that name, or else all whose name or words hold every word of the text; all of them for an empty one.
/// Throws InputError where there is none, which names near misses.
IFOV_API std::vector<Material> search_materials(const std::string& text = {});

/// Positions of a material's curves: all, or the one with this name or number, from 1. Throws InputError where there is no
/// such.
IFOV_API std::vector<std::size_t> curves_of(const Material& material, const std::string& curve = {});

/// A measured complex refractive index n + ik relative to vacuum, k >= 0 where it absorbs: scattering models take it by name.
struct RefractiveIndex {
  std::string name, about, source;          ///< what was measured, and its publication
  std::vector<double> wavelength_um, n, k;  ///< as many
};
/// The built-in table.
IFOV_API std::vector<RefractiveIndex> refractive_indices();

// What `ifov materials` prints and draws.

/// One line for each, under the names of their groups.
IFOV_API std::string materials_list(const std::vector<Material>& materials);
IFOV_API std::string material_text(const Material& material, const std::vector<std::size_t>& curves);
/// Name, range, what was measured and its source.
IFOV_API std::string refractive_indices_list(const std::vector<RefractiveIndex>& indices);
/// A table which the document's `csv` reads.
IFOV_API std::string material_csv(const Material& material, const std::vector<std::size_t>& curves);
/// PNG. Throws SystemError where it cannot be drawn.
IFOV_API std::string material_figure(const Material& material, const std::vector<std::size_t>& curves);

}  // namespace ifov
