#include "session/solved/other_side.h"

#include <cmath>

#include "exposure/exposed_point.h"
#include "geometry/surface_point.h"
#include "geometry/world.h"
#include "sampling/random.h"
#include "sampling/warp.h"
#include "thermal/solid.h"

namespace ifov::session {
namespace {

constexpr double kThickest_m = 0.1;  // of a sheet, more is a wall
constexpr int kRaysBehind = 16, kLeastOutdoors = 4, kSkyPairsOfSheet = 64;

/// Rays by their cosines from the other side: to the sky and to outsides, against insides, which are seen from behind.
bool is_outdoors(const exposure::PastScene& past, const geometry::SurfacePoint& behind, std::uint64_t key) {
  const exposure::ExposedPoint exposed(past, behind);
  const sampling::TangentFrame frame(exposed.normal());
  int outdoors = 0, indoors = 0;
  for (int k = 0; k < kRaysBehind; ++k) {
    const auto number = [&](int of) { return sampling::unit_double(sampling::hash(key, k, of)); };
    const math::Vec3 along =
        frame.to_world(sampling::cosine_hemisphere({(k + number(0)) / kRaysBehind, number(1)}));
    if (!exposed.leaves(along)) continue;
    const math::Ray ray = exposed.ray(along);
    geometry::SurfacePoint met;
    past.world().intersect({&ray, 1}, {&met, 1});
    if (met.hit() ? met.front : along.z > 0.0)
      ++outdoors;
    else if (met.hit())
      ++indoors;
  }
  return outdoors >= std::max(kLeastOutdoors, indoors);
}

}  // namespace

std::optional<double> other_side_k(const Neighbourhood& about, const SolvedMaterial& solved,
                                   const geometry::SurfacePoint& point, std::uint64_t key, double full_k) {
  const thermal::Solid& solid = solved.thermal.solid;
  double thickness_m = 0.0;
  for (const thermal::SolidLayer& layer : solid.layers) thickness_m += layer.thickness_m;
  if (!std::holds_alternative<thermal::Insulated>(solid.back) || thickness_m > kThickest_m ||
      solved.thermal.start == thermal::Start::air || solved.thermal.skin.is_held())
    return std::nullopt;
  geometry::SurfacePoint behind = point;
  behind.front = !point.front;
  if (!is_outdoors(about.past, behind, key)) return std::nullopt;
  SolvedMaterial sheet = solved;
  sheet.thermal.skin.two_faces = true;
  const exposure::SolvedSurface surface =
      exposure::SolvedSurface(solved.classes, about.past, about.sun_radius_rad).exposed_on(true);
  const auto exposure = surface.exposure(point, key, kSkyPairsOfSheet, 1);
  return std::abs(full_solution(sheet, about.series, about.stand, surface.normal_at(point), exposure)
                      .history.nodes.back()
                      .surface_k -
                  full_k);
}

double across_k(const Neighbourhood& about, const SolvedMaterial& solved, const geometry::SurfacePoint& point,
                std::uint64_t key, double full_k) {
  const exposure::SolvedSurface surface =
      exposure::SolvedSurface(solved.classes, about.past, about.sun_radius_rad).exposed_on(false);
  thermal::Skin one = solved.thermal.skin;
  one.two_faces = false;
  double apart_w_m2 = 0.0;
  for (const bool other : {false, true}) {
    geometry::SurfacePoint face = point;
    if (other) face.front = !point.front;
    const auto exposure = surface.exposure(face, sampling::hash(key, other), kSkyPairsOfSheet, 1);
    const thermal::SurfaceBalance balance =
        face_balance(solved, one, about.series, about.stand, surface.normal_at(face), exposure, {});
    apart_w_m2 += (other ? -1.0 : 1.0) * balance.gain(solved.classes->end_s(), full_k).w_m2;
  }
  // A face gains half of the difference more than the mean of both, which goes to the middle of the sheet and on.
  return 0.25 * std::abs(apart_w_m2) * thermal::resistance_across_m2_k_w(solved.thermal.solid.layers);
}

}  // namespace ifov::session
