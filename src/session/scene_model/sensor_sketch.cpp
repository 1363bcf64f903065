#include "session/scene_model/sensor_sketch.h"

#include "geometry/world.h"
#include "sensor/camera.h"
#include "sensor/view_list.h"
#include "sensor/view_list_camera.h"

namespace ifov::session {
namespace {

constexpr int kAlongSide = 24;   // points of the outline along a side of the image
constexpr int kAlongTrack = 64;  // places of a sensor that moves

using Sight = SensorSketch::Sight;

std::vector<Sight> sights(const geometry::World& world, const std::vector<math::Ray>& rays) {
  std::vector<geometry::SurfacePoint> points(rays.size());
  world.intersect(rays, points);
  std::vector<Sight> found;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    found.push_back({rays[k].origin_m, rays[k].direction, std::nullopt});
    if (points[k].hit()) found.back().to_m = points[k].position_m;
  }
  return found;
}

/// Around a picture: clockwise from the upper left corner, kAlongSide points a side.
std::vector<Sight> around(const geometry::World& world, const sensor::Camera& camera) {
  const double w = camera.width_px(), h = camera.height_px();
  std::vector<math::Ray> rays;
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < kAlongSide; ++k) {
      const double t = static_cast<double>(k) / kAlongSide;
      const double x[] = {t * w, w, w - t * w, 0.0}, y[] = {0.0, t * h, h, h - t * h};
      rays.push_back(camera.ray({x[side], y[side]}));
    }
  return sights(world, rays);
}

void sketch_outline(const geometry::World& world, const sensor::Camera& camera, SensorSketch& sketch) {
  const std::vector<Sight> all = around(world, camera);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k % kAlongSide == 0) sketch.corners.push_back(all[k]);
    sketch.outline_m.push_back(all[k].to_m);
  }
}

const char* name_of(sensor::ViewList::Kind kind) {
  switch (kind) {
    case sensor::ViewList::Kind::directions: return "directions";
    case sensor::ViewList::Kind::hemisphere: return "hemisphere";
    case sensor::ViewList::Kind::points: return "points";
    case sensor::ViewList::Kind::rays: return "rays";
  }
  return "views";
}

void sketch_views(const geometry::World& world, const sensor::ViewListCamera& list, SensorSketch& sketch) {
  const sensor::ViewList::Kind kind = list.list()->kind;
  sketch.kind = name_of(kind);
  sketch.view_count = static_cast<std::size_t>(list.width_px());
  // Of more of them every n-th.
  const std::size_t step = (sketch.view_count + SensorSketch::kMostViews - 1) / SensorSketch::kMostViews;
  std::vector<math::Ray> rays;
  for (std::size_t k = 0; k < sketch.view_count; k += step) rays.push_back(list.view(k).middle_ray());
  sketch.views = sights(world, rays);
  if (!sketch.views.empty()) sketch.axis = sketch.views[sketch.views.size() / 2];
  // All of them are of one area.
  if (kind == sensor::ViewList::Kind::directions || kind == sensor::ViewList::Kind::hemisphere) {
    sketch.is_parallel = true;
    sketch_outline(world, list.view(0), sketch);
    sketch.corners.clear();
  }
}

}  // namespace

SensorSketch sketch_of(const sensor::Camera& camera, const geometry::World& world) {
  SensorSketch sketch;
  sketch.kind = "image";
  sketch.width_px = camera.width_px(), sketch.height_px = camera.height_px();
  if (const sensor::ViewListCamera* const list = camera.view_list()) {
    sketch_views(world, *list, sketch);
    return sketch;
  }
  const sensor::CameraPose first = camera.pose(0.5), last = camera.pose(camera.height_px() - 0.5);
  sketch.is_parallel = !first.position_m;
  sketch.duration_s = last.time_s - first.time_s;
  if (sketch.duration_s != 0.0 && !sketch.is_parallel)
    for (int k = 0; k <= kAlongTrack; ++k) {
      const auto pose = camera.pose(camera.height_px() * static_cast<double>(k) / kAlongTrack);
      if (pose.position_m) sketch.track_m.push_back(*pose.position_m);
    }
  sketch.axis = sights(world, {camera.middle_ray()}).front();
  sketch_outline(world, camera, sketch);
  return sketch;
}

}  // namespace ifov::session
