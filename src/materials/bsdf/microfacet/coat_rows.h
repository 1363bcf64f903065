#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "materials/bsdf/event/bsdf_event.h"
#include "materials/bsdf/microfacet/facet_distribution.h"
#include "materials/bsdf/microfacet/row_weights.h"
#include "radiometry/spectrum.h"

namespace ifov::materials {

/// What a clear surface of facets, as steep to all sides, lets through by the angle of light: T(cos) = 1 -
/// what it reflects, as often as it may. What is spread evenly under it and leaves it again is T(cos out)
/// T(cos in) / T_mean times that of the base: reciprocal, and of a white base all comes back (Kelemen and
/// Szirmay-Kalos 2001).
struct CoatRows {
  static constexpr std::size_t kCount = 33;

  /// T at kCount angles, the last straight, then its mean over a hemisphere, out of the rows of FresnelRows.
  static std::vector<radiometry::Spectrum> of_fresnel(FacetShape shape, double width,
                                                      std::span<const radiometry::Spectrum> fresnel);
  /// How much more of what passes is polarized in the plane of its direction and the normal (p) than across
  /// it, at the same angles: -1/2 (R_p - R_s) of the facets, about that plane. `along`: of
  /// FresnelRows::polarization_of_index() the first kCount.
  static std::vector<radiometry::Spectrum> polarization_of_fresnel(
      FacetShape shape, double width, std::span<const radiometry::Spectrum> along);
  static RowWeights at(double cosine);
  /// The cubic between `rows`, kCount of them, at `weights`.
  static double mixed(RowWeights weights, std::span<const double> rows);

  /// Adds T(cos out) T(cos in) x `under` / pi, with what both passages do to polarization; `passed` and
  /// `along` are rows of of_fresnel() and polarization_of_fresnel().
  static void add_under(double cosine_out, double cosine_in, ParameterSpectra passed, ParameterSpectra along,
                        const float* under, std::size_t count, const MuellerRows& rows);
};

/// Mean over the hemisphere of the reflectance that rows of FresnelRows hold.
double mean_reflectance(std::span<const double> fresnel);

/// Means of spectra over their wavelengths: what models decide paths by before these have wavelengths.
std::vector<double> grey_levels(std::span<const radiometry::Spectrum> spectra);

}  // namespace ifov::materials
