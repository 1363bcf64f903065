#include "render/object_seeds.h"

#include <algorithm>
#include <cmath>

namespace ifov::render {

namespace {

/// Parts of a long object get a seed each, this far apart or as far as it is wide: well below a pixel, so that a
/// following trace of its edges meets the next.
constexpr double kSpacing_px = 0.35;

/// An object whose every direction is wider than this meets the detection lattice anyway.
constexpr double kSeeded_px = 1.0;

}  // namespace

ObjectSeeds::ObjectSeeds(const geometry::World& world, const sensor::Camera& camera, double margin_px) {
  auto add = [&](math::Point3 position_m, std::uint32_t object) {
    sampling::FocalPoint point;
    if (!camera.project(position_m, point)) return;
    if (point.x_px < -margin_px || point.y_px < -margin_px || point.x_px > camera.width_px() + margin_px ||
        point.y_px > camera.height_px() + margin_px)
      return;
    points_.push_back({point, object});
  };
  for (std::size_t number = 0; number < world.object_count(); ++number) {
    const geometry::World::PlacedObject object = world.object(number);
    if (!object.compact) continue;
    const double gsd_m = camera.gsd_m(object.centre_m);
    if (object.width_m > kSeeded_px * gsd_m) continue;
    const double half_length_m = math::length(object.half_length_m);
    const double spacing_m = std::max(kSpacing_px * gsd_m, object.width_m);
    const int parts = std::max(1, static_cast<int>(std::ceil(2.0 * half_length_m / spacing_m)));
    if (2.0 * half_length_m <= kSeeded_px * gsd_m || parts == 1) {
      add(object.seed_m, static_cast<std::uint32_t>(number));
      continue;
    }
    // What is thin may be met at one end and missed at the other.
    const bool thin = object.width_m < kSpacing_px * gsd_m;
    for (int k = 0; k < parts; ++k)
      add(object.centre_m + object.half_length_m * ((2.0 * k + 1.0) / parts - 1.0),
          thin ? sampling::Field::kNoObject : static_cast<std::uint32_t>(number));
  }

  lowest_row_ = static_cast<int>(std::floor(-margin_px));
  std::stable_sort(points_.begin(), points_.end(), [](const auto& a, const auto& b) {
    return std::floor(a.point.y_px) < std::floor(b.point.y_px);
  });
  const int rows = static_cast<int>(std::ceil(camera.height_px() + margin_px)) - lowest_row_ + 1;
  first_of_row_.assign(static_cast<std::size_t>(rows) + 1, points_.size());
  for (std::size_t k = points_.size(); k-- > 0;)
    first_of_row_[static_cast<std::size_t>(static_cast<int>(std::floor(points_[k].point.y_px)) - lowest_row_)] = k;
  for (std::size_t row = first_of_row_.size() - 1; row-- > 0;)
    first_of_row_[row] = std::min(first_of_row_[row], first_of_row_[row + 1]);
}

ObjectSeeds::Near ObjectSeeds::near(sampling::PixelRect tile, double margin_px) const {
  Near found;
  const int last = static_cast<int>(first_of_row_.size()) - 1;
  const int low = std::clamp(static_cast<int>(std::floor(tile.y0 - margin_px)) - lowest_row_, 0, last);
  const int high = std::clamp(static_cast<int>(std::ceil(tile.y1 + margin_px)) - lowest_row_, 0, last);
  for (std::size_t k = first_of_row_[static_cast<std::size_t>(low)]; k < first_of_row_[static_cast<std::size_t>(high)];
       ++k) {
    const sampling::FocalPoint& point = points_[k].point;
    if (point.x_px >= tile.x0 - margin_px && point.x_px < tile.x1 + margin_px &&
        point.y_px >= tile.y0 - margin_px && point.y_px < tile.y1 + margin_px) {
      found.points.push_back(point);
      found.objects.push_back(points_[k].object);
    }
  }
  return found;
}

}  // namespace ifov::render
