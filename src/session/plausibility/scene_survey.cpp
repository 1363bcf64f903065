#include "session/plausibility/scene_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "geometry/world.h"
#include "io/document/document.h"
#include "render/field/make_field.h"
#include "render/image_renderer.h"
#include "sampling/hash.h"
#include "sensor/camera.h"
#include "session/loaded/parts.h"
#include "transport/spectral_scene.h"

namespace ifov::session {
namespace {

constexpr int kAcross = 48;
constexpr int kAcrossChunks = 8;              // where each place that is met has a tree of its own to be made
constexpr std::size_t kMostSurveyed = 20000;  // copies of an object
constexpr double kOneLocation =
    1e-5;  // of a pixel: nearer surfaces of unlike objects are taken to be meant as one

void include(SceneSurvey::Range& range, double value) {
  range.low = std::min(range.low, value), range.high = std::max(range.high, value);
}

std::vector<sampling::FocalPoint> grid_of(const sensor::Camera& camera, int across) {
  if (camera.view_list() != nullptr)  // each pixel may hold a scene
    return sensor::grid_over(camera, across, across);
  return sensor::grid_over(camera, std::min(across, camera.width_px()), std::min(across, camera.height_px()));
}

void see(const Parts& parts, std::span<const sampling::FocalPoint> points, SceneSurvey& survey) {
  const geometry::World& world = *parts.scene.world;
  std::vector<math::Ray> rays(points.size());
  parts.camera->rays(points, rays);
  std::vector<geometry::SurfacePoint> hits(points.size()), behind(points.size());
  world.intersect(rays, hits);
  std::vector<math::Ray> onward = rays;
  const double each = 1.0 / static_cast<double>(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    onward[k].t_max_m = hits[k].hit() ? hits[k].distance_m : 0.0;
    if (!hits[k].hit()) {
      survey.sky_share += each;
      if (rays[k].direction.z < 0.0) survey.down_share += each;
      continue;
    }
    const math::Point3 p = hits[k].position_m;
    const double gsd_m = parts.camera->gsd_m(p);
    include(survey.distance_m, hits[k].distance_m), include(survey.gsd_m, gsd_m);
    include(survey.x_m, p.x), include(survey.y_m, p.y);
    // What lies in the same place but for rounding, and what a reader of heights would call the same place.
    onward[k].t_min_m = hits[k].distance_m + kOneLocation * gsd_m * 1e-3;
    onward[k].t_max_m = hits[k].distance_m + kOneLocation * gsd_m;
  }
  world.intersect(onward, behind);
  std::map<std::pair<std::size_t, std::size_t>, double> pairs;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!hits[k].hit()) continue;
    const std::size_t seen = parts.placed.of(hits[k].instance);
    std::size_t hidden = parts.placed.document_objects();
    if (hits[k].shared_with != geometry::kNoMaterial)
      hidden = parts.placed.of(hits[k].shared_with);
    else if (behind[k].hit())
      hidden = parts.placed.of(behind[k].instance);
    if (hidden < parts.placed.document_objects() && hidden != seen) pairs[{seen, hidden}] += each;
  }
  for (const auto& [pair, share] : pairs) survey.shared.push_back({pair.first, pair.second, share});
}

void measure(const Parts& parts, std::span<const sampling::FocalPoint> points, SceneSurvey& survey) {
  const auto field = render::make_field(*parts.spectral_scene, *parts.camera, parts.job().transport,
                                        render::LabelDetail::material, parts.job().polarimetry);
  std::vector<sampling::PathRequest> requests;
  for (const sampling::FocalPoint& point : points)
    requests.push_back({point, sampling::hash(parts.document.seed, 0x10c, requests.size()), 0});
  std::vector<sampling::Label> labels(points.size());
  std::vector<float> values(points.size() * static_cast<std::size_t>(field->stride()));
  field->values(requests, labels, values);
  for (std::size_t k = 0; k < points.size(); ++k)
    for (std::size_t c = 0; c < survey.radiance.size(); ++c)
      include(survey.radiance[c],
              static_cast<double>(values[k * static_cast<std::size_t>(field->stride()) + c]));
}

void light(const Parts& parts, SceneSurvey& survey) {
  const radiometry::SpectralNodes& nodes = *parts.nodes;
  const double sine = parts.scene.sun ? std::max(0.0, parts.scene.sun->direction.z) : 0.0;
  for (std::size_t c = 0; c < nodes.channel_count(); ++c) {
    double sun = 0.0, sky = 0.0;
    for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n) {
      sun += nodes.node_weight(n) * sine * static_cast<double>(parts.spectral_scene->sun_irradiance()[n]);
      sky += nodes.node_weight(n) * std::numbers::pi *
             static_cast<double>(parts.spectral_scene->sky_radiance()[n]);
    }
    survey.sun.push_back({sun, sun}), survey.sky.push_back({sky, sky});
  }
}

/// Whether a ball's picture reaches into the frame, about: by its middle and the size of a pixel there.
bool in_frame(const sensor::Camera& camera, const geometry::World::PlacedObject& object) {
  if (!std::isfinite(object.radius_m)) return true;
  sampling::FocalPoint point;
  if (!camera.project(object.centre_m, point)) return false;
  const double reach_px = object.radius_m / std::max(camera.gsd_m(object.centre_m), 1e-30);
  return point.x_px + reach_px > 0.0 && point.x_px - reach_px < camera.width_px() &&
         point.y_px + reach_px > 0.0 && point.y_px - reach_px < camera.height_px();
}

void count(const Parts& parts, SceneSurvey& survey) {
  const geometry::World& world = *parts.scene.world;
  survey.objects = world.object_count();
  for (std::size_t d = 0; d < parts.placed.document_objects(); ++d) {
    const std::size_t copies = parts.placed.count(d);
    const std::size_t step = copies / kMostSurveyed + 1;
    std::size_t inside = 0, surveyed = 0;
    for (std::size_t k = 0; k < copies; k += step, ++surveyed)
      inside += world.period() || parts.camera->view_list() != nullptr ||
                in_frame(*parts.camera, world.object(parts.placed.first(d) + k));
    survey.in_frame.push_back(inside), survey.surveyed.push_back(surveyed);
  }
}

}  // namespace

SceneSurvey survey_scene(const Parts& parts) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr SceneSurvey::Range kEmpty{kInfinity, -kInfinity};
  SceneSurvey survey;
  survey.radiance.assign(parts.channels.size(), kEmpty);
  survey.distance_m = survey.gsd_m = survey.x_m = survey.y_m = kEmpty;
  // Rays would make the trees of large meshes, which belongs to rendering.
  const std::vector<sampling::FocalPoint> points =
      grid_of(*parts.camera, parts.scene.world->storage().chunks > 0 ? kAcrossChunks : kAcross);
  survey.rays = points.size();
  see(parts, points, survey);
  measure(parts, points, survey);
  light(parts, survey);
  count(parts, survey);
  return survey;
}

}  // namespace ifov::session
