#include "transport/mirrors/sun_mirrors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ifov::transport {

namespace {

using geometry::SurfaceSurvey;
using math::Point3;
using math::Vec3;

/// Sequences of facings that are tried for images.
constexpr std::size_t kMostWays = 1 << 14;

/// Faces whose planes differ by less than this count as one.
constexpr double kSamePlane_m = 1e-3;

Vec3 mirrored(Vec3 direction, Vec3 normal) { return direction - 2.0 * dot(direction, normal) * normal; }

SurfaceSurvey::Ball around(const SurfaceSurvey::Ball& a, const SurfaceSurvey::Ball& b) {
  const Vec3 between = b.centre_m - a.centre_m;
  const double apart = length(between);
  if (apart + b.radius_m <= a.radius_m) return a;
  if (apart + a.radius_m <= b.radius_m) return b;
  const double radius = 0.5 * (apart + a.radius_m + b.radius_m);
  return {a.centre_m + between * ((radius - a.radius_m) / apart), radius};
}

/// Halves of a list of balls along its longest side, until few enough are left.
void group(std::span<SurfaceSurvey::Ball> balls, std::size_t groups, std::vector<SurfaceSurvey::Ball>& out) {
  if (balls.empty()) return;
  if (groups <= 1 || balls.size() == 1) {
    out.push_back(std::accumulate(balls.begin() + 1, balls.end(), balls.front(), around));
    return;
  }
  const auto coordinate = [](const SurfaceSurvey::Ball& ball, int axis) {
    return axis == 0 ? ball.centre_m.x : axis == 1 ? ball.centre_m.y : ball.centre_m.z;
  };
  int longest = 0;
  double side = -1.0;
  for (int axis = 0; axis < 3; ++axis) {
    double low = coordinate(balls.front(), axis), high = low;
    for (const auto& ball : balls) {
      low = std::min(low, coordinate(ball, axis));
      high = std::max(high, coordinate(ball, axis));
    }
    if (high - low > side) side = high - low, longest = axis;
  }
  const auto middle = balls.size() / 2;
  std::nth_element(
      balls.begin(), balls.begin() + static_cast<std::ptrdiff_t>(middle), balls.end(),
      [&](const auto& a, const auto& b) { return coordinate(a, longest) < coordinate(b, longest); });
  group(balls.first(middle), groups / 2, out);
  group(balls.subspan(middle), groups - groups / 2, out);
}

}  // namespace

SunMirrors::SunMirrors(const scene::Scene& scene, const SurfaceSurvey& survey)
    : survey_(survey), rounds_(scene, survey) {
  for (const scene::SurfaceAssignment& assignment : scene.assignments)
    bends_.push_back(assignment.bends_normals());
  std::vector<std::size_t> order(survey.flats.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t kept = std::min(order.size(), kMostFacings);
  by_shape_ = !scene.world->period() && survey.all_flats && kept == order.size();
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return survey.flats[a].area_m2 > survey.flats[b].area_m2;
  });
  std::vector<SurfaceSurvey::Ball> balls = survey.balls;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const SurfaceSurvey::Flat& flat = survey.flats[order[k]];
    if (k < kept)
      facings_.push_back({flat.normal, flat.bounds, flat.high_m - flat.low_m < kSamePlane_m});
    else
      balls.push_back({flat.bounds.low_m + (flat.bounds.high_m - flat.bounds.low_m) * 0.5,
                       0.5 * length(flat.bounds.high_m - flat.bounds.low_m)});
  }
  // A relief bends what is flat.
  if (std::find(bends_.begin(), bends_.end(), true) != bends_.end() && !facings_.empty())
    for (const Facing& facing : facings_)
      balls.push_back({facing.bounds.low_m + (facing.bounds.high_m - facing.bounds.low_m) * 0.5,
                       0.5 * length(facing.bounds.high_m - facing.bounds.low_m)});
  balls.insert(balls.end(), rounds_.unsought().begin(), rounds_.unsought().end());
  group(balls, kMostGroups, groups_);
}

std::uint32_t SunMirrors::facing_of(const geometry::SurfacePoint& hit, Vec3 normal) const {
  if (hit.bend == geometry::Bend::round || hit.bend == geometry::Bend::field || bends_[hit.material])
    return kNone;
  std::uint32_t nearest = kNone;
  double along = 1.0 - 2.0 * SurfaceSurvey::kSameNormal_rad * SurfaceSurvey::kSameNormal_rad;
  for (std::uint32_t k = 0; k < facings_.size(); ++k) {
    const double here = std::abs(dot(facings_[k].normal, normal));
    if (here > along) along = here, nearest = k;
  }
  return nearest;
}

SunImages::SunImages(const SunMirrors& mirrors, Vec3 towards_sun, int reflections)
    : towards_sun_(towards_sun) {
  for (const SunMirrors::Facing& facing : mirrors.facings()) normals_.push_back(facing.normal);
  struct Way {
    Vec3 image;
    std::uint32_t first;  // facing; the last facing is met last on the way from the surface
  };
  std::vector<Way> ways{{towards_sun, SunMirrors::kNone}};
  for (int length = 1; length <= std::min(reflections, kMostReflections) && !normals_.empty(); ++length) {
    if (ways.size() * normals_.size() > kMostWays) return;
    const std::vector<Image> before = images_;
    std::vector<Way> longer;
    std::vector<std::vector<bool>> known;  // by image and first facing
    for (const Way& way : ways)
      for (std::uint32_t first = 0; first < normals_.size(); ++first) {
        const SunMirrors::Facing& facing = mirrors.facings()[first];
        if (way.first == first && facing.one_plane) continue;
        const Vec3 image = mirrored(way.image, facing.normal);
        const std::uint32_t index = index_of(image, facing.bounds);
        if (images_.size() > (length > 2 ? kMostOfLongWays : kMost)) {
          images_ = before;
          return;
        }
        known.resize(images_.size(), std::vector<bool>(normals_.size()));
        if (known[index][first]) continue;
        known[index][first] = true;
        longer.push_back({images_[index].direction, first});
      }
    ways = std::move(longer);
    reflections_ = length;
  }
}

std::uint32_t SunImages::find(Vec3 direction) const {
  constexpr double kSame = 4.0 * SurfaceSurvey::kSameNormal_rad;
  for (std::uint32_t k = 0; k < images_.size(); ++k)
    if (length(images_[k].direction - direction) <= kSame) return k;
  return SunMirrors::kNone;
}

std::uint32_t SunImages::index_of(Vec3 direction, const geometry::World::Bounds& first) {
  const std::uint32_t known = find(direction);
  if (known == SunMirrors::kNone) {
    images_.push_back({normalized(direction), first});
    return static_cast<std::uint32_t>(images_.size() - 1);
  }
  geometry::World::Bounds& b = images_[known].bounds;
  b.low_m = {std::min(b.low_m.x, first.low_m.x), std::min(b.low_m.y, first.low_m.y),
             std::min(b.low_m.z, first.low_m.z)};
  b.high_m = {std::max(b.high_m.x, first.high_m.x), std::max(b.high_m.y, first.high_m.y),
              std::max(b.high_m.z, first.high_m.z)};
  return known;
}

std::uint32_t SunImages::image_of(std::span<const std::uint16_t> facings) const {
  if (facings.empty() || static_cast<int>(facings.size()) > reflections_) return SunMirrors::kNone;
  Vec3 image = towards_sun_;
  for (std::size_t k = facings.size(); k-- > 0;) image = mirrored(image, normals_[facings[k]]);
  return find(image);
}

bool may_meet(const geometry::World::Bounds& box, Point3 from, Vec3 direction, double slope) {
  const Vec3 half = (box.high_m - box.low_m) * 0.5;
  const double pad = 1e-9 + slope * (length(box.low_m + half - from) + length(half));
  double enter = 0.0, leave = 1e300;
  const double low[3] = {box.low_m.x, box.low_m.y, box.low_m.z},
               high[3] = {box.high_m.x, box.high_m.y, box.high_m.z};
  const double at[3] = {from.x, from.y, from.z}, along[3] = {direction.x, direction.y, direction.z};
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1.0 / (along[axis] == 0.0 ? 1e-300 : along[axis]);
    const double a = (low[axis] - pad - at[axis]) * inverse, b = (high[axis] + pad - at[axis]) * inverse;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

}  // namespace ifov::transport
