#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "materials/bsdf/boundary/cosine_lobe.h"
#include "materials/bsdf/boundary/rough_boundary.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"

namespace ifov::materials {

struct RoughBoundaryTables {
  static constexpr std::size_t kAngles = 65;  // of what is lost
  // Places in spectra: reflected by facets (times the factor) and let through, by FresnelRows; what facets send to others, by angle, from
  // outside and from within; what becomes of that (over pi L_mean): reflected, from outside and from within; through from outside, n^2 times as much as from within.
  static constexpr std::size_t kReflected = 0, kThrough = FresnelRows::kCount,
                               kLost = 2 * FresnelRows::kCount, kAgainReflected = kLost + 2 * kAngles,
                               kAgainThrough = kAgainReflected + 2;

  // Places in polarization, by FresnelRows too: M_01, Re and Im of r_p conj(r_s) of what facets reflect (times the factor); M_01 and M_22
  // of what they let through, whose amplitudes are in phase.
  static constexpr std::size_t kReflectedAlong = 0, kReflectedCosine = FresnelRows::kCount,
                               kReflectedSine = 2 * FresnelRows::kCount,
                               kThroughAlong = 3 * FresnelRows::kCount,
                               kThroughCosine = 4 * FresnelRows::kCount;

  RoughBoundaryTables(const radiometry::Spectrum& n, const radiometry::Spectrum& k,
                      const radiometry::Spectrum& factor, const RoughBoundary::Surface& surface);

  FacetDistribution facets;
  double index = 1.0;
  std::optional<radiometry::Spectrum> absorption;
  std::vector<radiometry::Spectrum> spectra, polarization;
  std::vector<double> grey;  // their means over wavelengths
  /// Of one side and way, by angle: how often the diffuse lobe is drawn.
  std::array<std::array<std::vector<double>, 2>, 2> broad;  // [from within][through]

  /// Of what facets send to others, as it leaves on either side: outside, within.
  std::array<CosineLobe, 2> diffuse;

  /// How much of what goes on goes through, by angle: from outside, from within.
  std::array<std::vector<double>, 2> passed;

  /// Linear between the angles.
  static double share_at(const std::vector<double>& shares, double cosine);
  static RowWeights angle_at(double cosine);

 private:
  void add_lost(const radiometry::Spectrum& factor);
  void add_polarization(const radiometry::Spectrum& n, const radiometry::Spectrum& k,
                        const radiometry::Spectrum& factor, const std::vector<radiometry::Spectrum>& fresnel);
  std::array<std::array<std::vector<double>, 2>, 2> share_at_once_;  // as broad: what leaves at once, grey
};

}  // namespace ifov::materials
