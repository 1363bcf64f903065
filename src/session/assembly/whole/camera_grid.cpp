#include "session/assembly/whole/camera_grid.h"

namespace ifov::session {

std::vector<geometry::SurfacePoint> hits_of_camera(const geometry::World& world, const sensor::Camera& camera,
                                                   int across, std::vector<math::Ray>* rays,
                                                   double margin_px) {
  std::vector<sampling::FocalPoint> points;
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < across; ++i)
      points.push_back({(i + 0.5) / across * (camera.width_px() + 2.0 * margin_px) - margin_px,
                        (j + 0.5) / across * (camera.height_px() + 2.0 * margin_px) - margin_px});
  std::vector<math::Ray> sent(points.size());
  camera.rays(points, sent);
  std::vector<geometry::SurfacePoint> hits(points.size());
  world.intersect(sent, hits);
  if (rays != nullptr) *rays = std::move(sent);
  return hits;
}

}  // namespace ifov::session
