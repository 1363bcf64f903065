#include "transport/mirrors/sun_images.h"

#include <algorithm>

#include "geometry/world/surface_survey.h"
#include "transport/mirrors/sun_mirrors.h"

namespace ifov::transport {

namespace {

using geometry::SurfaceSurvey;
using math::Vec3;

/// Sequences of facings that are tried for images.
constexpr std::size_t kMostWays = 1 << 14;

Vec3 mirrored(Vec3 direction, Vec3 normal) { return direction - 2.0 * dot(direction, normal) * normal; }

}  // namespace

SunImages::SunImages(const SunMirrors& mirrors, Vec3 towards_sun, int reflections,
                     std::size_t most_of_long_ways)
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
        if (images_.size() > (length > 2 ? most_of_long_ways : kMost)) {
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

}  // namespace ifov::transport
