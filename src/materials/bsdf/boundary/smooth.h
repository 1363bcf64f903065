#pragma once

#include <string_view>

#include "materials/bsdf/bsdf_model.h"

namespace ifov::materials {

/// A smooth boundary of a medium of complex index n + ik: Fresnel's equations (radiometry/fresnel.h). Over a medium the light that is
/// not reflected goes on refracted; over an absorber it ends.
namespace smooth {

extern const BsdfModel kModel;

/// "medium", "absorber".
std::span<const std::string_view> bases();

/// What a medium is besides its boundary.
struct Medium {
  double index = 1.0;               ///< by which directions are bent: n where it absorbs least
  radiometry::Spectrum absorption;  ///< 4 pi k / wavelength, 1/m (Born and Wolf, section 14.1)
  /// Light ends within micrometres at all wavelengths: as good as an absorber.
  bool is_opaque = false;
};
Medium medium_of(const radiometry::Spectrum& n, const radiometry::Spectrum& k);

/// `factor` of what is reflected: 1 where the surface is clean.
std::shared_ptr<const Bsdf> make(const radiometry::Spectrum& n, const radiometry::Spectrum& k,
                                 const radiometry::Spectrum& factor, bool over_medium);

}  // namespace smooth

}  // namespace ifov::materials
