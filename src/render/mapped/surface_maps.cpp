#include "render/mapped/surface_maps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/surface_point.h"
#include "math/ray.h"
#include "radiometry/spectral_nodes.h"
#include "radiometry/spectrum_block.h"
#include "render/parts/part_columns.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/path_record.h"
#include "transport/spectral_scene.h"
#include "transport/view_atmosphere.h"

namespace ifov::render {

/// Spectra that are worked out in turn, in nodes.
struct SurfaceMaps::Work {
  explicit Work(const transport::SpectralScene& scene) : air(scene) {
    spectra.resize(kRows, scene.node_count());
  }
  enum Row {
    kEmission,
    kEmissionPart,
    kEmissionWork,
    kOwn,
    kReflectance,
    kParts,
    kRows = kParts + transport::kLightParts
  };
  transport::ViewAtmosphere air;
  radiometry::SpectrumBlock spectra;
  std::vector<math::Ray> rays;
};

SurfaceMaps::SurfaceMaps(const transport::SpectralScene& scene, const sensor::Camera& camera,
                         const PartColumns& parts, Shares shares)
    : scene_(scene),
      camera_(camera),
      parts_(parts),
      shares_(std::move(shares)),
      work_(std::make_unique<Work>(scene)) {
  for (const scene::SurfaceAssignment& assignment : scene.scene().assignments) {
    const auto is_map = [](const auto& map) { return map != nullptr; };
    differs_.push_back(
        !assignment.patterns.empty() || (assignment.classes != nullptr && assignment.states.size() > 1) ||
        std::any_of(assignment.temperatures.begin(), assignment.temperatures.end(), is_map) ||
        std::any_of(assignment.back_temperatures.begin(), assignment.back_temperatures.end(), is_map));
    any_ = any_ || differs_.back() != 0;
  }
}

SurfaceMaps::~SurfaceMaps() = default;

class SurfaceMaps::Surface final : public sampling::MappedSurface {
 public:
  Surface(const SurfaceMaps& maps, const geometry::SurfacePoint& hit, std::size_t stride)
      : maps_(maps), hit_(hit), stride_(stride) {}

  /// How texture coordinates go on along the surface, from those of two more points of it.
  void follow_coordinates(const geometry::SurfacePoint& right, const geometry::SurfacePoint& below) {
    const math::Vec3 a = right.position_m - hit_.position_m, b = below.position_m - hit_.position_m;
    const double aa = math::dot(a, a), ab = math::dot(a, b), bb = math::dot(b, b), d = aa * bb - ab * ab;
    if (!(d > 1e-9 * aa * bb)) return;
    // Vectors in the plane of a and b that give 1 with the one and 0 with the other.
    const math::Vec3 of_a = (bb / d) * a - (ab / d) * b, of_b = (aa / d) * b - (ab / d) * a;
    u_per_m_ = (right.u - hit_.u) * of_a + (below.u - hit_.u) * of_b;
    v_per_m_ = (right.v - hit_.v) * of_a + (below.v - hit_.v) * of_b;
  }

  void look_up(std::span<const sampling::FocalPoint> points, std::span<float> own,
               std::span<float> reflectance) const override {
    Work& work = *maps_.work_;
    const transport::SpectralScene& scene = maps_.scene_;
    work.rays.resize(points.size());
    maps_.camera_.rays(points, work.rays);
    for (std::size_t k = 0; k < points.size(); ++k) {
      float *own_row = &own[k * stride_], *reflectance_row = &reflectance[k * stride_];
      std::fill(own_row, own_row + stride_, 0.0f);
      std::fill(reflectance_row, reflectance_row + stride_, 0.0f);
      const geometry::SurfacePoint at = met_by(work.rays[k]);
      const scene::ResolvedSurface surface = scene.scene().resolve_without_temperature(at);
      write_own(surface, at, work.rays[k], own_row);
      write_reflectance(surface, reflectance_row);
      if (maps_.shares_) maps_.shares_(at, own_row);
    }
  }

 private:
  /// Where a ray meets the tangent plane.
  geometry::SurfacePoint met_by(const math::Ray& ray) const {
    geometry::SurfacePoint at = hit_;
    const math::Vec3 normal = hit_.geometric_normal.as_vector();
    const double towards = math::dot(ray.direction, normal);
    if (std::abs(towards) < 1e-6) return at;
    const double t = math::dot(hit_.position_m - ray.origin_m, normal) / towards;
    if (!(t > 0.0) || !std::isfinite(t)) return at;
    at.position_m = ray.origin_m + t * ray.direction;
    const math::Vec3 moved = at.position_m - hit_.position_m;
    at.u += math::dot(u_per_m_, moved);
    at.v += math::dot(v_per_m_, moved);
    return at;
  }

  void write_own(const scene::ResolvedSurface& surface, const geometry::SurfacePoint& at,
                 const math::Ray& ray, float* row) const {
    Work& work = *maps_.work_;
    const transport::SpectralScene& scene = maps_.scene_;
    float* own = work.spectra.row(Work::kOwn);
    const float* emitted = scene.emission(surface, -ray.direction, work.spectra.row(Work::kEmission));
    if (emitted != nullptr)
      std::copy_n(emitted, scene.stride(), own);
    else
      std::fill(own, own + scene.stride(), 0.0f);
    transport::PathRecord::Path path;
    path.towards_sensor = -ray.direction;
    path.sensor_height_m = ray.origin_m.z;
    path.met = true;
    path.seen_height_m = at.position_m.z;
    path.seen_x_m = at.position_m.x, path.seen_y_m = at.position_m.y;
    if (maps_.parts_.told()) write_parts(own, path, row);
    work.air.apply(path, own);
    scene.nodes().to_channels(own, row);
  }

  /// Of what a surface sends of its own, before the air.
  void write_parts(const float* own, const transport::PathRecord::Path& path, float* row) const {
    Work& work = *maps_.work_;
    transport::PartRows rows;
    for (std::size_t p = 0; p < transport::kLightParts; ++p) {
      rows.row[p] = work.spectra.row(Work::kParts + p);
      std::fill_n(rows.row[p], maps_.scene_.stride(), 0.0f);
    }
    float* emitted = rows[transport::LightPart::emitted];
    std::copy_n(own, maps_.scene_.stride(), emitted);
    work.air.dim(path, emitted);
    work.air.apply(path, rows[transport::LightPart::path]);
    work.air.transmittance(path, rows[transport::LightPart::transmittance]);
    maps_.parts_.write(rows, row);
  }

  void write_reflectance(const scene::ResolvedSurface& surface, float* row) const {
    const transport::SpectralScene& scene = maps_.scene_;
    float* sum = maps_.work_->spectra.row(Work::kReflectance);
    std::fill(sum, sum + scene.stride(), 0.0f);
    for (const scene::Constituent& part : surface) {
      const float* reflectance = scene.materials().reflectance(part.material);
      const float weight = static_cast<float>(part.weight);
      for (std::size_t n = 0; n < scene.stride(); ++n) sum[n] += weight * reflectance[n];
    }
    scene.nodes().to_channels(sum, row);
    // All light that comes in may be of any part; what none of them has is left to 0 by the fit.
    const std::size_t channels = scene.nodes().channel_count();
    for (std::size_t p = 0; maps_.parts_.told() && p < transport::kRadianceParts; ++p)
      std::copy_n(row, channels, row + maps_.parts_.first() + p * channels);
  }

  const SurfaceMaps& maps_;
  geometry::SurfacePoint hit_;
  std::size_t stride_;
  math::Vec3 u_per_m_{}, v_per_m_{};
};

std::unique_ptr<sampling::MappedSurface> SurfaceMaps::about(std::span<const geometry::SurfacePoint> hits,
                                                            std::size_t stride) const {
  auto surface = std::make_unique<Surface>(*this, hits[0], stride);
  const auto same = [&](const geometry::SurfacePoint& other) {
    return other.hit() && other.instance == hits[0].instance && other.patch == hits[0].patch &&
           other.copy_column == hits[0].copy_column && other.copy_row == hits[0].copy_row;
  };
  if (same(hits[1]) && same(hits[2])) surface->follow_coordinates(hits[1], hits[2]);
  return surface;
}

}  // namespace ifov::render
