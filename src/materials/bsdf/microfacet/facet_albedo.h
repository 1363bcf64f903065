#pragma once

#include <memory>
#include <vector>

#include "materials/bsdf/microfacet/facet_distribution.h"

namespace ifov::materials {

/// What facets that absorb nothing reflect once, and a lobe for the light that they reflect more often, so that nothing is lost:
/// Kulla and Conty 2017 (Revisiting physically based shading at Imageworks, SIGGRAPH course). Directions as FacetDistribution has
/// them, above the horizon.
class FacetAlbedo {
 public:
  explicit FacetAlbedo(const FacetDistribution& facets);
  /// One table for all who have the same facets.
  static std::shared_ptr<const FacetAlbedo> shared(FacetShape shape, double width_x, double width_y);

  /// 1 - E: share of light from `direction` that facets send to other facets. Cubic between tabulated directions.
  double lost(math::Vec3 direction) const;
  /// 1 - E_avg: the mean of lost() over projected solid angle.
  double mean_lost() const { return mean_lost_; }
  /// BSDF of the light that is reflected more than once by facets that absorb nothing, 1/sr. Its directional-hemispherical
  /// reflectance is lost().
  double again(double lost_out, double lost_in) const;
  /// What becomes of a reflectance whose mean over a hemisphere is `mean`, from the second reflection on: mean^2 E_avg / (1 -
  /// mean (1 - E_avg)), over what it is of 1. Every reflection takes its part: with the square it is the first one too.
  double again_factor(double mean) const {
    return mean * mean * (1.0 - mean_lost_) / (1.0 - mean * mean_lost_);
  }

  /// Directions in proportion to lost x cosine, of its mean over azimuth.
  math::Vec3 sample(sampling::Point2 u) const;
  double pdf(math::Vec3 direction) const;
  sampling::Point2 invert(math::Vec3 direction) const;

 private:
  double position_of(double cosine) const;
  double cosine_at(double position) const;
  void add_lobe();
  double mean_over_azimuth(double cosine) const;
  std::size_t interval_of(double cosine) const;

  double width_x_, width_y_, scale_;
  std::size_t azimuths_;
  std::vector<double> lost_;  // by azimuth, then by cosine
  double mean_lost_ = 0.0;
  std::vector<double> cosine_, lobe_,
      below_;  // knots; density of the cosine there; share of the lobe below them
};

}  // namespace ifov::materials
