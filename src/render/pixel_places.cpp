#include "render/pixel_places.h"

#include <limits>

namespace ifov::render {

void locate_pixels(const geometry::World& world, const sensor::Camera& camera, sampling::TileResult& tile) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  const auto width = static_cast<std::size_t>(tile.tile.width());
  std::vector<sampling::FocalPoint> points(width);
  std::vector<math::Ray> rays(width);
  std::vector<geometry::SurfacePoint> hits(width);
  tile.position_m.clear();
  tile.position_m.reserve(3 * static_cast<std::size_t>(tile.tile.count()));
  for (int y = tile.tile.y0; y < tile.tile.y1; ++y) {
    for (std::size_t x = 0; x < width; ++x)
      points[x] = {tile.tile.x0 + static_cast<double>(x) + 0.5, y + 0.5};
    camera.rays(points, rays);
    world.intersect(rays, hits);
    for (const geometry::SurfacePoint& hit : hits) {
      const math::Point3 p = hit.hit() ? hit.position_m : math::Point3{kNowhere, kNowhere, kNowhere};
      tile.position_m.insert(tile.position_m.end(), {p.x, p.y, p.z});
    }
  }
}

}  // namespace ifov::render
