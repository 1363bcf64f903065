#include "render/mirrors/glints.h"

#include <cmath>
#include <numbers>

#include "geometry/world.h"
#include "radiometry/polarization_frame.h"
#include "radiometry/spectrum_block.h"
#include "render/mirrors/exposed_points.h"
#include "render/mirrors/sought_instants.h"
#include "render/parts/part_columns.h"
#include "render/polarized/polarimetry.h"
#include "render/polarized/stokes_columns.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/mirrors/sun_mirrors.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

/// Steps across the Sun's half-angle: fewer where there are many mirrors.
int steps_for(std::size_t surfaces) { return surfaces <= 64 ? 16 : surfaces <= 1024 ? 8 : 4; }

/// Points traced together.
constexpr std::size_t kPointsAtOnce = 4096;

}  // namespace

bool Glints::in(const transport::SpectralScene& scene) {
  if (scene.sun_mirrors() == nullptr) return false;
  const geometry::SurfaceSurvey& survey = scene.sun_mirrors()->survey();
  return !survey.rounds.empty() || !survey.smooths.empty();
}

Glints::Glints(const transport::SpectralScene& scene, const sensor::Camera& camera, double margin_px,
               std::uint64_t seed, const LightTold& told)
    : scene_(scene),
      camera_(camera),
      seed_(seed),
      mirrored_(scene),
      polarized_(told.polarimetry != nullptr && told.polarimetry->any()),
      stokes_(std::make_unique<StokesColumns>(told, scene.nodes())),
      lights_(stokes_->count()) {
  const geometry::SurfaceSurvey& survey = scene.sun_mirrors()->survey();
  const scene::Sun& sun = *scene.scene().sun;
  std::size_t surfaces = survey.rounds.size();
  for (const auto& smooth : survey.smooths) surfaces += smooth.triangles.size() > 1000 ? 1 : 0;
  const SoughtInstants instants(scene.scene(), camera, seed);
  std::vector<GlintPoint> points;
  for (std::size_t k = 0; k < instants.size(); ++k) {
    GlintSearch search(instants.camera(k), sun.direction, sun.half_angle_rad, margin_px, steps_for(surfaces),
                       instants.seed(k));
    const auto keep = [&](const GlintPoint& point) {
      points.push_back(instants.point(k, point));
      if (points.size() == kPointsAtOnce) trace(points);
    };
    std::uint64_t number = 0;
    for (const auto& round : survey.rounds) {
      last_material_ = ~0u;
      search.search(round, number++, keep);
      trace(points);
    }
    for (const auto& smooth : survey.smooths) {
      last_material_ = ~0u;
      search.search(smooth, number++, keep);
      trace(points);
    }
  }
  lights_.sort();
}

Glints::~Glints() = default;

void Glints::trace(std::vector<GlintPoint>& points) {
  const scene::Scene& scene = scene_.scene();
  const scene::Sun& sun = *scene.sun;
  spread_over_exposure(scene, camera_, seed_, points);
  std::vector<sampling::FocalPoint> images;
  for (const GlintPoint& point : points) images.push_back(point.image);
  std::vector<math::Ray> rays(points.size());
  std::vector<geometry::SurfacePoint> hits(points.size());
  camera_.rays(images, rays);
  scene.world->intersect(rays, hits);

  struct Leg {
    std::size_t point;
    std::uint32_t spectrum;
  };
  std::vector<Leg> legs;
  std::vector<math::Ray> to_sun;
  const double sine = std::sin(sun.half_angle_rad);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const geometry::SurfacePoint& hit = hits[k];
    // What was searched must be what is seen.
    if (!hit.hit() || !scene_.sun_mirrors()->glints_by_shape(hit)) continue;
    if (math::length(hit.position_m - points[k].at_m) > 1e-6 * (1.0 + hit.distance_m)) continue;
    const scene::ResolvedSurface surface = scene.resolve(hit);
    const math::Vec3 normal = surface.shading_normal.as_vector(), seen = rays[k].direction;
    math::Vec3 from = math::normalized(seen - 2.0 * math::dot(seen, normal) * normal);
    if (sun.half_angle_rad <= 0.0)
      from = sun.direction;
    else if (!(math::length(math::cross(from, sun.direction)) < sine) || math::dot(from, sun.direction) < 0.0)
      continue;
    const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
    if (!(math::dot(from, outward) > 0.0) || !(from.z > 0.0)) continue;
    legs.push_back({k, row_of(hit, surface, rays[k], images[k])});
    to_sun.push_back(rays[k].onward(hit.position_m + hit.offset_m * outward, from));
  }
  std::vector<std::uint8_t> blocked(to_sun.size());
  if (!to_sun.empty()) scene.world->occluded(to_sun, blocked);
  const double disc_sr = sun.half_angle_rad > 0.0 ? std::numbers::pi * sine * sine : 1.0;
  for (std::size_t k = 0; k < legs.size(); ++k) {
    if (blocked[k] != 0) continue;
    const GlintPoint& point = points[legs[k].point];
    lights_.add({point.image, static_cast<float>(point.area / disc_sr), legs[k].spectrum, point.replicate});
  }
  points.clear();
}

std::uint32_t Glints::row_of(const geometry::SurfacePoint& hit, const scene::ResolvedSurface& surface,
                             const math::Ray& seen, const sampling::FocalPoint& image) {
  // One surface of one material has one row: its glint is small. Where reflection depends on the angle, one for about one angle.
  constexpr double kSameCosine = 5e-4;
  const double cosine = std::abs(math::dot(surface.shading_normal.as_vector(), seen.direction));
  const math::Vec3 normal = surface.shading_normal.as_vector();
  bool same_angle = scene_.materials().directional(surface.constituents[0].material) == nullptr;
  // Polarization has the plane of incidence besides.
  if (!same_angle)
    same_angle = polarized_ ? math::length(normal - last_normal_) < kSameCosine
                            : std::abs(cosine - last_cosine_) < kSameCosine;
  if (surface.count == 1 && surface.constituents[0].material == last_material_ && same_angle)
    return last_row_;
  last_cosine_ = cosine;
  last_normal_ = normal;
  last_material_ = surface.count == 1 ? surface.constituents[0].material : ~0u;
  radiometry::SpectrumBlock work(1, scene_.node_count());
  const float* sun = scene_.sun_irradiance(hit.position_m.z, work.row(0));
  std::vector<float> columns(stokes_->count());
  if (polarized_)
    stokes_->write(
        mirrored_.polarized(surface, hit.position_m.z, seen, sun, sensor::focal_frame(camera_, image, seen)),
        columns.data());
  else
    stokes_->write_unpolarized(mirrored_.channels(surface, hit.position_m.z, seen, sun), columns.data());
  stokes_->parts().write_one(transport::LightPart::sun, columns.data());
  last_row_ = lights_.add_spectrum(columns);
  return last_row_;
}

}  // namespace ifov::render
