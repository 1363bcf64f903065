#include "materials/bsdf/microfacet/facet_refraction.h"

#include <math.h>  // lgamma_r: std::lgamma writes a global

#include <algorithm>
#include <cmath>

namespace ifov::materials {
namespace {

using math::Vec3;

double log_gamma(double x) {
  int sign = 0;
  return ::lgamma_r(x, &sign);
}

/// 1 + Lambda.
double area_over_cosine(const FacetDistribution& facets, Vec3 direction) {
  constexpr double kGrazing = 1e-6;
  const Vec3 above{direction.x, direction.y, std::max(kGrazing, std::abs(direction.z))};
  return std::max(1.0, facets.projected_area(above) / above.z);
}

}  // namespace

double seen_from_both_sides(const FacetDistribution& facets, Vec3 out, Vec3 in) {
  const double a = area_over_cosine(facets, out), b = area_over_cosine(facets, in);
  return std::exp(log_gamma(a) + log_gamma(b) - log_gamma(a + b));
}

Vec3 refracting_facet(Vec3 out, Vec3 in, double ratio) {
  const Vec3 sum = out + ratio * in;
  const double length = math::length(sum);
  if (!(length > 1e-9)) return {};
  const Vec3 facet = (sum.z > 0.0 ? 1.0 : -1.0) / length * sum;
  return math::dot(out, facet) > 0.0 && math::dot(in, facet) < 0.0 ? facet : Vec3{};
}

Vec3 refracted_by(Vec3 facet, Vec3 out, double ratio) {
  const double cosine = math::dot(out, facet), square = 1.0 - (1.0 - cosine * cosine) / (ratio * ratio);
  if (!(square > 0.0)) return {};
  return math::normalized((cosine / ratio - std::sqrt(square)) * facet - out / ratio);
}

FacetRefraction::FacetRefraction(const FacetDistribution& facets, Vec3 out, Vec3 in, double ratio) {
  const Vec3 facet = refracting_facet(out, in, ratio);
  if (!(facet.z > 0.0)) return;
  cosine_out = math::dot(out, facet);
  cosine_in = -math::dot(in, facet);
  const double across = cosine_out - ratio * cosine_in, d = facets.density(facet);
  const double jacobian = ratio * ratio * cosine_in / (across * across);
  density = d * cosine_out / facets.projected_area(out) * jacobian;
  bsdf = d * cosine_out * jacobian * seen_from_both_sides(facets, out, in) / (out.z * -in.z);
}

}  // namespace ifov::materials
