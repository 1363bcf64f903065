#pragma once

#include "materials/bsdf/bsdf.h"

namespace ifov::materials {

/// Directional-hemispherical reflectance (transmittance) of a model that is not separable, towards `cosine` above the
/// surface, in `count` wavelengths: over 4096 directions drawn by the model itself on a grid, 2e-4 of itself from the integral
/// for smooth models; as near with 16384 directions of its lobe for one that has a seam(). Models with a direction are averaged over azimuth.
void directional_hemispherical(const Bsdf& bsdf, Side side, ParameterSpectra parameters, std::size_t count,
                               double cosine, float* spectrum);

/// The same of a model that polarizes, with Q of what leaves of unpolarized light of radiance 1 from all directions of that side, in
/// the plane of the direction and the normal (DHR_00 and DHR_10, or DHT). `parameters` as Bsdf::evaluate_mueller.
void polarized_hemispherical(const Bsdf& bsdf, Side side, ParameterSpectra parameters, std::size_t count,
                             double cosine, float* whole, float* q);

/// In place of a cosine: of light and views from all sides alike.
inline constexpr double kBihemispherical = -1.0;

/// The same as a spectrum, at the wavelengths of the model's own spectra, over 4096 directions of either lobe (1e-3 of itself); `cosine` may be kBihemispherical.
radiometry::Spectrum directional_hemispherical(const Bsdf& bsdf, Side side, double cosine);

}  // namespace ifov::materials
