#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "io/library/material_library.h"

namespace ifov::io {

/// One line for each material, under the names of their groups.
std::string list_materials(std::span<const LibraryMaterial* const> materials);

/// Description, and of each curve (positions in the material) its sample, range, means and what was not
/// measured.
std::string describe_material(const LibraryMaterial& material, std::span<const std::size_t> curves);

/// A table in text: wavelength_um, then a column of reflectance for each curve, and one of transmittance
/// where it has one; comment lines name the samples. The document's `csv` key reads it.
std::string material_csv(const LibraryMaterial& material, std::span<const std::size_t> curves);

/// A refractive index that scattering models take by name.
struct IndexText {
  std::string name, about, source;
  double first_um = 0.0, last_um = 0.0;
};
/// Three lines for each: name and range, what was measured, publication.
std::string list_indices(std::span<const IndexText> indices);

}  // namespace ifov::io
