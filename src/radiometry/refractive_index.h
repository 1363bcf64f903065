#pragma once

#include <span>
#include <string_view>

#include "radiometry/spectrum.h"

namespace ifov::radiometry {

/// A measured complex refractive index n + ik relative to vacuum, k >= 0 where it absorbs (docs/formats/data.md).
struct RefractiveIndex {
  std::string_view name;
  std::string_view about;   ///< what was measured
  std::string_view source;  ///< publication
  Spectrum n, k;            ///< at the same wavelengths; an error outside them
};

/// The built-in table, by name.
std::span<const RefractiveIndex> refractive_indices();
std::span<const std::string_view> refractive_index_names();
/// Throws InputError, with the choices, where there is none of that name.
const RefractiveIndex& refractive_index(std::string_view name);

/// Every measured value, however small: the table leaves out what reflectance does not need, and light in snow, ice crystals
/// and droplets is absorbed by k of 1e-11 to 1e-3. "ice" at 266 K, 0.191 to 160 um (Warren and Brandt 2008), "water" at 25 degC,
/// 0.2 to 59 um (k of Segelstein 1981; n, which is needed to three digits, of the table above: Hale and Querry 1973); data/indices. Null: there is none of that name.
const RefractiveIndex* whole_refractive_index(std::string_view name);

}  // namespace ifov::radiometry
