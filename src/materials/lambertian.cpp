#include "materials/lambertian.h"

#include <numbers>

#include "math/frame.h"
#include "sampling/warp.h"

namespace ifov::materials {

ScatterSample Lambertian::sample(math::Vec3, math::Normal3 normal, double u1, double u2) const {
  const math::Vec3 local = sampling::cosine_hemisphere({u1, u2});
  return {math::frame_from_normal(normal).outer_from_local(local), 1.0, local.z / std::numbers::pi, false};
}

double Lambertian::evaluate(math::Vec3 outgoing, math::Vec3 incoming, math::Normal3 normal) const {
  return math::dot(normal, incoming) > 0.0 && math::dot(normal, outgoing) > 0.0 ? 1.0 / std::numbers::pi
                                                                                : 0.0;
}

double Lambertian::pdf(math::Vec3, math::Vec3 incoming, math::Normal3 normal) const {
  const double cosine = math::dot(normal, incoming);
  return cosine > 0.0 ? cosine / std::numbers::pi : 0.0;
}

UnitSquarePoint Lambertian::invert(math::Vec3, math::Vec3 incoming, math::Normal3 normal) const {
  const math::Vec3 local = math::frame_from_normal(normal).local_from_outer(incoming);
  const sampling::Point2 u = sampling::cosine_hemisphere_inverse(local);
  return {u.x, u.y};
}

}  // namespace ifov::materials
