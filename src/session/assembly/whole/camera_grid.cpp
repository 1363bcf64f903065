#include "session/assembly/whole/camera_grid.h"

#include "sensor/camera.h"

namespace ifov::session {

std::vector<geometry::SurfacePoint> hits_of_camera(const geometry::World& world, const sensor::Camera& camera,
                                                   int across, std::vector<math::Ray>* rays,
                                                   double margin_px) {
  const std::vector<sampling::FocalPoint> points = sensor::grid_over(camera, across, across, margin_px);
  std::vector<math::Ray> sent(points.size());
  camera.rays(points, sent);
  std::vector<geometry::SurfacePoint> hits(points.size());
  world.intersect(sent, hits);
  if (rays != nullptr) *rays = std::move(sent);
  return hits;
}

}  // namespace ifov::session
