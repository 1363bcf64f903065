#pragma once

#include <cstdint>

#include "materials/bsdf/microfacet/facet_reflection.h"

namespace ifov::materials {

enum class SlopeStatistics : std::uint8_t { isotropic, anisotropic, skewed };

/// Slopes of the sea by the wind (Cox and Munk 1954, Measurement of the roughness of the sea surface from
/// photographs of the sun's glitter, J. Opt. Soc. Am. 44, 838; clean surface, wind at 12.5 m):
///   isotropic    both variances together 0.003 + 0.00512 U, half of it each way
///   anisotropic  along the wind 0.00316 U, across it 0.003 + 0.00192 U, Gaussian
///   skewed       the same, times their Gram-Charlier series
/// Directions as FacetDistribution has them, with x to where the wind comes from.
class SeaSlopes {
 public:
  SeaSlopes(double wind_m_s, SlopeStatistics statistics);

  double variance_along() const { return variance_along_; }
  double variance_across() const { return variance_across_; }
  bool is_skewed() const { return is_skewed_; }
  /// The Gaussian alone, from which facets are drawn: widths are sqrt 2 standard deviations.
  const FacetDistribution& gaussian() const { return gaussian_; }

  /// As FacetDistribution::density().
  double density(math::Vec3 facet) const { return gaussian_.density(facet) * series(facet); }
  /// As FacetDistribution::projected_area(); the moments of the series along the direction make their part of
  /// it.
  double projected_area(math::Vec3 direction) const;
  /// The series over the Gaussian, by a facet's normal. Cox and Munk found it for slopes up to 2.5 standard
  /// deviations; where it falls below 0 beyond them it counts as 0, where it exceeds 5 as 5, and it is scaled
  /// so that all slopes sum to 1.
  double series(math::Vec3 facet) const;

 private:
  double raw_series(double across, double along) const;

  double variance_along_, variance_across_;
  FacetDistribution gaussian_;
  bool is_skewed_;
  double c21_, c03_, scale_ = 1.0;
};

/// Light that such facets reflect once; its density is that of drawing by a visible facet of the Gaussian.
struct SeaReflection : FacetReflection {
  SeaReflection(const SeaSlopes& slopes, math::Vec3 out, math::Vec3 in);
};

}  // namespace ifov::materials
