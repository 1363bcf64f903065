#include "exposure/exposed_point.h"

#include "exposure/past_scene.h"
#include "geometry/presence.h"
#include "geometry/world.h"
#include "sampling/random.h"
#include "sampling/warp.h"
#include "thermal/wind_profile.h"

namespace ifov::exposure {
namespace {

constexpr int kTries = 64;  // of a direction that comes out above the horizon
constexpr double kLevel = 1.0 - 1e-9;

struct LeavingRays {
  std::vector<math::Ray> rays;
  std::vector<std::uint8_t> blocked;
  std::vector<std::size_t> owner;
};

}  // namespace

ExposedPoint::ExposedPoint(const PastScene& scene, const geometry::SurfacePoint& point) : scene_(scene) {
  outward_ = point.geometric_normal.as_vector();
  normal_ = point.shading_normal.as_vector();
  if (!point.front) {
    outward_ = -outward_;
    normal_ = -normal_;
  }
  origin_m_ = point.position_m + point.offset_m * outward_;
  if (scene.changes()) presence_ = scene.world().presence(point.instance);
}

thermal::Pose ExposedPoint::pose() const {
  return {normal_, scene_.height_above_ground_m(origin_m_, thermal::kLowestWind_m)};
}

double ExposedPoint::time_here_s(double time_s) const {
  return presence_ != nullptr ? presence_->nearest(time_s) : time_s;
}

void ExposedPoint::free(std::span<const math::Vec3> directions, std::span<const double> times_s,
                        std::span<std::uint8_t> is_free) const {
  static thread_local LeavingRays scratch;
  scratch.rays.clear();
  scratch.owner.clear();
  for (std::size_t k = 0; k < directions.size(); ++k) {
    is_free[k] = 0;
    if (!leaves(directions[k])) continue;
    scratch.rays.push_back({.origin_m = origin_m_, .direction = directions[k]});
    if (!times_s.empty()) scratch.rays.back().time_s = time_here_s(times_s[k]);
    scratch.owner.push_back(k);
  }
  scratch.blocked.resize(scratch.rays.size());
  if (!scratch.rays.empty()) scene_.occluded(scratch.rays, scratch.blocked);
  for (std::size_t k = 0; k < scratch.owner.size(); ++k) is_free[scratch.owner[k]] = scratch.blocked[k] == 0;
}

bool ExposedPoint::leaves(math::Vec3 direction) const {
  return math::dot(direction, outward_) > 0.0 && math::dot(direction, normal_) > 0.0;
}

math::Ray ExposedPoint::ray(math::Vec3 direction) const {
  return {.origin_m = origin_m_, .direction = direction};
}

void ExposedPoint::sky_directions(std::uint64_t key, int pairs, std::vector<math::Vec3>& directions) const {
  this->directions(key, pairs, true, directions);
}

void ExposedPoint::ground_directions(std::uint64_t key, int pairs,
                                     std::vector<math::Vec3>& directions) const {
  this->directions(key, pairs, false, directions);
}

void ExposedPoint::directions(std::uint64_t key, int pairs, bool up,
                              std::vector<math::Vec3>& directions) const {
  directions.clear();
  const sampling::TangentFrame frame(normal_);
  // Strata that a tilted surface's horizon cuts would not have the same share of its sky.
  const bool level = normal_.z > kLevel;
  for (int k = 0; k < 2 * pairs; ++k) {
    const int stratum = k / 2;
    bool found = false;
    for (int attempt = 0; attempt < kTries && !found; ++attempt) {
      const double x = sampling::unit_double(sampling::hash(key, k, attempt, 0)),
                   y = sampling::unit_double(sampling::hash(key, k, attempt, 1));
      const math::Vec3 direction =
          frame.to_world(sampling::cosine_hemisphere({x, level ? (stratum + y) / pairs : y}));
      if ((direction.z > 0.0) != up) continue;
      directions.push_back(direction);
      found = true;
    }
    if (!found) return directions.clear();
  }
}

}  // namespace ifov::exposure
