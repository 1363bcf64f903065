#include "render/bright_places.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "sensor/camera.h"
#include "transport/shining_parts.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

/// What is larger is met by a pixel's own points.
constexpr double kSmall_px = 1.0;
/// As far away as this all places of a scene and its sensor are one.
constexpr double kAsFar_m = 1e13;

}  // namespace

sampling::BrightPlaces bright_places(const transport::SpectralScene& scene, const sensor::Camera& camera,
                                     std::span<const WingSpots::Box> others,
                                     std::span<const math::Vec3> glare, double half_angle_rad) {
  std::vector<WingSpots::Box> boxes;
  const auto add = [&](const std::optional<WingSpots::Box>& box) {
    if (box && 2.0 * std::max(box->half_width_px, box->half_height_px) <= kSmall_px) boxes.push_back(*box);
  };
  for (const WingSpots::Box& box : others) add(box);
  for (const math::Vec3 direction : glare)
    add(WingSpots::about(math::Point3{} + kAsFar_m * direction, kAsFar_m * std::tan(half_angle_rad), camera));
  const transport::ShiningParts shining(scene);
  for (const transport::ShiningParts::Part& part : shining.parts()) {
    std::optional<WingSpots::Box> box = WingSpots::about(part.ball.centre_m, part.ball.radius_m, camera);
    if (box) box->strength = part.contrast * part.fill * box->area_px2();
    add(box);
  }
  if (boxes.size() > WingSpots::kMost) {
    std::stable_sort(boxes.begin(), boxes.end(), [](const WingSpots::Box& a, const WingSpots::Box& b) {
      return a.strength > b.strength;
    });
    boxes.resize(WingSpots::kMost);
  }
  std::vector<sampling::BrightPlaces::Box> places;
  for (const WingSpots::Box& box : boxes)
    places.push_back({box.centre, box.half_width_px, box.half_height_px, box.brightest});
  return sampling::BrightPlaces(places);
}

}  // namespace ifov::render
