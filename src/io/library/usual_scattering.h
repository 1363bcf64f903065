#pragma once

#include <span>
#include <string_view>

namespace ifov::io {

/// Which scattering model materials of the library are best used with. A judgement, not a measurement: the library's figures are
/// directional-hemispherical and say nothing of angles.
struct UsualScattering {
  std::string_view names;       ///< begins the materials' names; the first row that fits holds
  std::string_view model;       ///< its key
  std::string_view parameters;  ///< the value of "scattering" in a document; empty: they are the place's own
  std::string_view why;
  bool has_own_reflectance = false;  ///< of the model, which takes the place of the library's
};
std::span<const UsualScattering> usual_scattering();
/// Null where no row fits.
const UsualScattering* usual_scattering_of(std::string_view material);

}  // namespace ifov::io
