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

/// The numbers that lead to a direction of the cap of those whose mean with `view` is above the horizon, which is uniform in azimuth and height.
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

FacetDistribution::VisibleRow::VisibleRow(const FacetDistribution& facets, Vec3 view, double u1)
    : facets_(facets), view_(facets.stretched(view)) {
  if (facets.shape_ == FacetShape::ggx) {
    x_ = std::cos(2.0 * std::numbers::pi * u1);
    y_ = std::sin(2.0 * std::numbers::pi * u1);
    slope_ = 0.0;
  } else {
    const Slant slant(view_);
    x_ = slant.x;
    y_ = slant.y;
    slope_ = gaussian_slopes::seen_quantile(slant.cosine, slant.sine, u1);
  }
}

Vec3 FacetDistribution::VisibleRow::facet(double u2) const {
  const double width_x = facets_.width_x_, width_y = facets_.width_y_;
  if (facets_.shape_ == FacetShape::ggx) {
    const double drop = u2 * (1.0 + view_.z), sine = std::sqrt(std::max(0.0, drop * (2.0 - drop)));
    return math::normalized({width_x * (sine * x_ + view_.x), width_y * (sine * y_ + view_.y),
                             std::max(0.0, 1.0 - drop + view_.z)});
  }
  const double across = gaussian_slopes::quantile(u2);
  return math::normalized(
      {-width_x * (slope_ * x_ - across * y_), -width_y * (slope_ * y_ + across * x_), 1.0});
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
