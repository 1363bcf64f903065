#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/world.h"
#include "math/vec3.h"

namespace ifov::transport {

class SunMirrors;

/// Directions in which a surface sees the Sun by way of flat mirrors: s reflected about the normals of up to a number
/// of facings in turn. Sequences with the same image are one image, so that every way counts once; walls that stand
/// square to each other have three, however many reflections.
class SunImages {
 public:
  /// Up to so many are kept; fewer reflections are sought where there would be more.
  static constexpr std::size_t kMost = 1024;
  /// The same from the third reflection on: what they bring is not worth the noise of choosing among many.
  static constexpr std::size_t kMostOfLongWays = 24;
  /// Of a way, at most.
  static constexpr int kMostReflections = 8;

  SunImages() = default;
  SunImages(const SunMirrors& mirrors, math::Vec3 towards_sun, int reflections,
            std::size_t most_of_long_ways = kMostOfLongWays);

  struct Image {
    math::Vec3 direction;              ///< unit, from the surface
    geometry::World::Bounds bounds{};  ///< of the mirrors that are met first
  };
  std::span<const Image> images() const { return images_; }
  /// How many reflections are sought; 0: none.
  int reflections() const { return reflections_; }
  /// The image that mirrors of these facings, met in this order, make; SunMirrors::kNone where they cannot.
  std::uint32_t image_of(std::span<const std::uint16_t> facings) const;

 private:
  std::uint32_t find(math::Vec3 direction) const;
  std::uint32_t index_of(math::Vec3 direction, const geometry::World::Bounds& first);
  math::Vec3 towards_sun_{};
  std::vector<math::Vec3> normals_;  // by facing
  int reflections_ = 0;
  std::vector<Image> images_;
};

}  // namespace ifov::transport
