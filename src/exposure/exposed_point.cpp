#include "exposure/exposed_point.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exposure/past_scene.h"
#include "geometry/presence.h"
#include "geometry/world.h"
#include "sampling/random.h"
#include "sampling/warp.h"
#include "thermal/wind_profile.h"

namespace ifov::exposure {
namespace {

constexpr double kLevel = 1.0 - 1e-9;
constexpr int kMostDraws = 2000;  // numbers, for a direction to one side of the horizon

struct LeavingRays {
  std::vector<math::Ray> rays;
  std::vector<std::uint8_t> blocked;
  std::vector<std::size_t> owner;
};

}  // namespace

ExposedPoint::ExposedPoint(const PastScene& scene, const geometry::SurfacePoint& point, bool two_faces)
    : scene_(scene), two_faces_(two_faces) {
  outward_ = point.geometric_normal.as_vector();
  normal_ = point.shading_normal.as_vector();
  if (two_faces ? normal_.z < 0.0 : !point.front) {
    outward_ = -outward_;
    normal_ = -normal_;
  }
  origin_m_ = point.position_m + point.offset_m * outward_;
  behind_m_ = point.position_m - point.offset_m * outward_;
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
    scratch.rays.push_back(ray(directions[k]));
    if (!times_s.empty()) scratch.rays.back().time_s = time_here_s(times_s[k]);
    scratch.owner.push_back(k);
  }
  scratch.blocked.resize(scratch.rays.size());
  if (!scratch.rays.empty()) scene_.occluded(scratch.rays, scratch.blocked);
  for (std::size_t k = 0; k < scratch.owner.size(); ++k) is_free[scratch.owner[k]] = scratch.blocked[k] == 0;
}

bool ExposedPoint::leaves(math::Vec3 direction) const {
  const double outward = math::dot(direction, outward_), along = math::dot(direction, normal_);
  return (outward > 0.0 && along > 0.0) || (two_faces_ && outward < 0.0 && along < 0.0);
}

math::Ray ExposedPoint::ray(math::Vec3 direction) const {
  return {.origin_m = math::dot(direction, outward_) < 0.0 ? behind_m_ : origin_m_, .direction = direction};
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
  if (two_faces_) return of_both_faces(key, pairs, up, directions);
  const double cosine = std::clamp(normal_.z, -1.0, 1.0);
  const auto draw = [&](int k, int which) { return sampling::unit_double(sampling::hash(key, k, 0, which)); };
  if (std::abs(cosine) > kLevel) {
    if (up != (cosine > 0.0)) return;
    const sampling::TangentFrame frame(normal_);
    for (int k = 0; k < 2 * pairs; ++k)
      directions.push_back(
          frame.to_world(sampling::cosine_hemisphere({draw(k, 0), (k / 2 + draw(k, 1)) / pairs})));
    return;
  }
  // Seen along the normal the hemisphere is a disc, of which equal parts count alike, and the horizon a half of an ellipse: of a chord of
  // half-length h downhill, which lies between -h and h, what is above the horizon lies between -h and h cos.
  const math::Vec3 across = math::normalized(math::cross(normal_, math::Vec3{0.0, 0.0, 1.0}));
  const math::Vec3 downhill = math::cross(normal_, across);
  const double low = up ? -1.0 : cosine, high = up ? cosine : 1.0;
  for (int k = 0; k < 2 * pairs; ++k) {
    const double chord = std::sqrt(draw(k, 0)) * std::cos(2.0 * std::numbers::pi * draw(k, 1));
    const double half = std::sqrt(std::max(0.0, 1.0 - chord * chord));
    const double along = half * std::lerp(low, high, (k / 2 + draw(k, 2)) / pairs);
    const double out = std::sqrt(std::max(0.0, 1.0 - chord * chord - along * along));
    directions.push_back(chord * across + along * downhill + out * normal_);
  }
}

void ExposedPoint::of_both_faces(std::uint64_t key, int pairs, bool up,
                                 std::vector<math::Vec3>& directions) const {
  // One face sees (1 + cos) / 2 of the sky and the other the rest; of what is below the horizon it is the other way round.
  const double of_upper = 0.5 * (1.0 + std::clamp(normal_.z, -1.0, 1.0));
  for (int k = 0; k < 2 * pairs; ++k) {
    const auto draw = [&](int which) { return sampling::unit_double(sampling::hash(key, k, 1, which)); };
    const bool upper = draw(0) < (up ? of_upper : 1.0 - of_upper);
    const sampling::TangentFrame frame(upper ? normal_ : -normal_);
    math::Vec3 direction;
    int which = 1;
    do {
      direction = frame.to_world(sampling::cosine_hemisphere({draw(which), draw(which + 1)}));
      which += 2;
    } while ((direction.z > 0.0) != up && which < kMostDraws);
    directions.push_back(direction);
  }
}

}  // namespace ifov::exposure
