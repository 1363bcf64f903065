#include "materials/bsdf/microfacet/facet_distribution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/bsdf/microfacet/gaussian_slopes.h"

namespace ifov::materials {
namespace {

using math::Vec3;

/// Along and across the direction in which a view slants; any where it does not.
struct Slant {
  double cosine, sine;  ///< of the zenith angle
  double x, y;          ///< unit vector in the plane
  explicit Slant(Vec3 view) : cosine(std::max(0.0, view.z)), sine(std::hypot(view.x, view.y)) {
    x = sine > 0.0 ? view.x / sine : 1.0;
    y = sine > 0.0 ? view.y / sine : 0.0;
  }
};

/// Of the cap of directions whose mean with `view` is above the horizon: uniform in azimuth and height.
Vec3 on_cap(Vec3 view, sampling::Point2 u) {
  const double drop = u.y * (1.0 + view.z), sine = std::sqrt(std::max(0.0, drop * (2.0 - drop)));
  const double azimuth = 2.0 * std::numbers::pi * u.x;
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), 1.0 - drop};
}

sampling::Point2 on_cap_inverse(Vec3 view, Vec3 on_cap) {
  const double turn = std::atan2(on_cap.y, on_cap.x) / (2.0 * std::numbers::pi);
  return {turn < 0.0 ? turn + 1.0 : turn, std::clamp((1.0 - on_cap.z) / (1.0 + view.z), 0.0, 1.0)};
}

}  // namespace

double FacetDistribution::density(Vec3 facet) const {
  if (!(facet.z > 0.0)) return 0.0;
  const double x = facet.x / width_x_, y = facet.y / width_y_, z2 = facet.z * facet.z;
  const double across = x * x + y * y, scale = 1.0 / (std::numbers::pi * width_x_ * width_y_);
  if (shape_ == FacetShape::ggx) return scale / ((across + z2) * (across + z2));
  return scale * std::exp(-across / z2) / (z2 * z2);
}

double FacetDistribution::projected_area(Vec3 direction) const {
  const double across = std::hypot(width_x_ * direction.x, width_y_ * direction.y);
  const double cosine = std::max(0.0, direction.z);
  if (shape_ == FacetShape::ggx) return 0.5 * (cosine + std::hypot(cosine, across));
  return gaussian_slopes::seen(cosine, across);
}

Vec3 FacetDistribution::stretched(Vec3 direction) const {
  return math::normalized({width_x_ * direction.x, width_y_ * direction.y, std::max(0.0, direction.z)});
}

Vec3 FacetDistribution::sample_visible(Vec3 view, sampling::Point2 u) const {
  const Vec3 of_unit_width = stretched(view);
  if (shape_ == FacetShape::ggx) {
    const Vec3 sum = on_cap(of_unit_width, u) + of_unit_width;
    return math::normalized({width_x_ * sum.x, width_y_ * sum.y, std::max(0.0, sum.z)});
  }
  const Slant slant(of_unit_width);
  const double along = gaussian_slopes::seen_quantile(slant.cosine, slant.sine, u.x),
               across = gaussian_slopes::quantile(u.y);
  return math::normalized({-width_x_ * (along * slant.x - across * slant.y),
                           -width_y_ * (along * slant.y + across * slant.x), 1.0});
}

sampling::Point2 FacetDistribution::invert_visible(Vec3 view, Vec3 facet) const {
  const Vec3 of_unit_width = stretched(view);
  if (shape_ == FacetShape::ggx) {
    const Vec3 half = math::normalized({facet.x / width_x_, facet.y / width_y_, facet.z});
    return on_cap_inverse(of_unit_width, 2.0 * math::dot(of_unit_width, half) * half - of_unit_width);
  }
  const Slant slant(of_unit_width);
  const double slope_x = -facet.x / (width_x_ * facet.z), slope_y = -facet.y / (width_y_ * facet.z);
  return {gaussian_slopes::seen_share(slant.cosine, slant.sine, slope_x * slant.x + slope_y * slant.y),
          gaussian_slopes::share(slope_y * slant.x - slope_x * slant.y)};
}

}  // namespace ifov::materials
