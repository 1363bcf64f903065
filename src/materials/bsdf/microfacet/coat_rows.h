#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "materials/bsdf/microfacet/facet_distribution.h"
#include "materials/bsdf/microfacet/row_weights.h"
#include "radiometry/spectrum.h"

namespace ifov::materials {

/// What a clear surface of facets, as steep to all sides, lets through by the angle of light: T(cos) = 1 - what it reflects,
/// as often as it may. What is spread evenly under it and leaves it again is T(cos out) T(cos in) / T_mean times that of the base: reciprocal,
/// and of a white base all comes back (Kelemen and Szirmay-Kalos 2001).
struct CoatRows {
  static constexpr std::size_t kCount = 33;

  /// T at kCount angles, the last straight, then its mean over a hemisphere, out of the rows of FresnelRows.
  static std::vector<radiometry::Spectrum> of_fresnel(FacetShape shape, double width,
                                                      std::span<const radiometry::Spectrum> fresnel);
  static RowWeights at(double cosine);
  /// The cubic between `rows`, kCount of them, at `weights`.
  static double mixed(RowWeights weights, std::span<const double> rows);
};

/// Mean over the hemisphere of the reflectance that rows of FresnelRows hold.
double mean_reflectance(std::span<const double> fresnel);

/// Means of spectra over their wavelengths: what models decide paths by before these have wavelengths.
std::vector<double> grey_levels(std::span<const radiometry::Spectrum> spectra);

}  // namespace ifov::materials
