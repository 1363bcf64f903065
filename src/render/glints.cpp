#include "render/glints.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "radiometry/spectrum_block.h"
#include "render/accuracy_tolerance.h"
#include "sampling/quantiles.h"
#include "transport/mirror_ways.h"
#include "transport/spectral_scene.h"
#include "transport/sun_mirrors.h"
#include "transport/view_table.h"

namespace ifov::render {

namespace {

/// Steps across the Sun's half-angle: fewer where there are many mirrors.
int steps_for(std::size_t surfaces) { return surfaces <= 64 ? 16 : surfaces <= 1024 ? 8 : 4; }

/// Points traced together.
constexpr std::size_t kBatch = 4096;

}  // namespace

bool Glints::in(const transport::SpectralScene& scene) {
  if (scene.sun_mirrors() == nullptr) return false;
  const geometry::SurfaceSurvey& survey = scene.sun_mirrors()->survey();
  return !survey.rounds.empty() || !survey.smooths.empty();
}

Glints::Glints(const transport::SpectralScene& scene, const sensor::Camera& camera, double margin_px,
               std::uint64_t seed)
    : scene_(scene), camera_(camera), channels_(scene.nodes().channel_count()) {
  const geometry::SurfaceSurvey& survey = scene.sun_mirrors()->survey();
  const scene::Sun& sun = *scene.scene().sun;
  std::size_t surfaces = survey.rounds.size();
  for (const auto& smooth : survey.smooths) surfaces += smooth.triangles.size() > 1000 ? 1 : 0;
  GlintSearch search(camera, sun.direction, sun.half_angle_rad, margin_px, steps_for(surfaces), seed);
  std::vector<GlintPoint> points;
  const auto keep = [&](const GlintPoint& point) {
    points.push_back(point);
    if (points.size() == kBatch) trace(points);
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
  std::stable_sort(lights_.begin(), lights_.end(),
                   [](const Light& a, const Light& b) { return a.at.y_px < b.at.y_px; });
}

void Glints::trace(std::vector<GlintPoint>& points) {
  const scene::Scene& scene = scene_.scene();
  const scene::Sun& sun = *scene.sun;
  std::vector<sampling::FocalPoint> images;
  for (const GlintPoint& point : points) images.push_back(point.image);
  std::vector<math::Ray> rays(points.size());
  std::vector<geometry::SurfacePoint> hits(points.size());
  camera_.rays(images, rays);
  scene.world->intersect(rays, hits);

  struct Leg {
    std::size_t point;
    std::uint32_t row;
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
    legs.push_back({k, row_of(hit, surface, -seen)});
    to_sun.push_back({hit.position_m + hit.offset_m * outward, from});
  }
  std::vector<std::uint8_t> blocked(to_sun.size());
  if (!to_sun.empty()) scene.world->occluded(to_sun, blocked);
  const double disc_sr = sun.half_angle_rad > 0.0 ? std::numbers::pi * sine * sine : 1.0;
  for (std::size_t k = 0; k < legs.size(); ++k) {
    if (blocked[k] != 0) continue;
    const GlintPoint& point = points[legs[k].point];
    lights_.push_back({point.image, static_cast<float>(point.area / disc_sr), legs[k].row, point.replicate});
  }
  points.clear();
}

std::uint32_t Glints::row_of(const geometry::SurfacePoint& hit, const scene::ResolvedSurface& surface,
                             math::Vec3 towards_sensor) {
  // One surface of one material has one row: its glint is small.
  if (surface.count == 1 && surface.constituents[0].material == last_material_) return last_row_;
  last_material_ = surface.count == 1 ? surface.constituents[0].material : ~0u;
  last_row_ = static_cast<std::uint32_t>(rows_.size() / channels_);

  radiometry::SpectrumBlock work(2, scene_.node_count());
  std::vector<double> share(scene_.node_count(), 0.0);
  for (const scene::Constituent& part : surface)
    if (transport::is_mirror(scene_.scene(), part))
      for (std::size_t n = 0; n < share.size(); ++n)
        share[n] += part.weight * scene_.materials().reflectance(part.material)[n];
  const float* sun = scene_.sun_irradiance(hit.position_m.z, work.row(0));
  float* light = work.row(1);
  const transport::ViewTable* table = scene_.view_table();
  std::optional<transport::ViewTable::Place> place;
  if (table != nullptr) place = table->at(towards_sensor, hit.position_m.z);
  for (std::size_t n = 0; n < share.size(); ++n) {
    double through = scene_.has_view_path() ? scene_.view_transmittance()[n] : 1.0;
    if (place) {
      through = 0.0;
      for (std::size_t k = 0; k < place->count; ++k) through += place->weight[k] * place->transmittance[k][n];
    }
    light[n] = static_cast<float>(share[n] * sun[n] * through);
  }
  rows_.resize(rows_.size() + channels_);
  std::vector<float> channels(std::max(channels_, scene_.stride()));
  scene_.nodes().to_channels(light, channels.data());
  std::copy_n(channels.begin(), channels_, rows_.end() - static_cast<std::ptrdiff_t>(channels_));
  return last_row_;
}

void Glints::add_to(const sampling::PixelFootprint& footprint, const sampling::Tolerance* tolerance,
                    sampling::TileResult& tile) const {
  constexpr std::size_t kReplicates = GlintSearch::kReplicates;
  const double reach = footprint.half_width_px();
  const int width = tile.tile.width();
  std::vector<std::vector<double>> sums(static_cast<std::size_t>(tile.tile.count()));  // [replicate][channel]
  auto light = std::lower_bound(lights_.begin(), lights_.end(), tile.tile.y0 - reach - 1.0,
                                [](const Light& a, double y) { return a.at.y_px < y; });
  for (; light != lights_.end() && light->at.y_px < tile.tile.y1 + reach + 1.0; ++light) {
    // Pixels whose centres are within reach, each border to one of its sides.
    const auto range = [&](double at, int low, int high) {
      return std::pair{std::max(low, static_cast<int>(std::floor(at - 0.5 - reach)) + 1),
                       std::min(high - 1, static_cast<int>(std::floor(at - 0.5 + reach)))};
    };
    const auto [x0, x1] = range(light->at.x_px, tile.tile.x0, tile.tile.x1);
    const auto [y0, y1] = range(light->at.y_px, tile.tile.y0, tile.tile.y1);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const double weight = footprint.density(light->at.x_px - x - 0.5, light->at.y_px - y - 0.5) *
                              static_cast<double>(light->per_radiance);
        if (weight <= 0.0) continue;
        auto& sum = sums[static_cast<std::size_t>((y - tile.tile.y0) * width + x - tile.tile.x0)];
        if (sum.empty()) sum.assign(kReplicates * channels_, 0.0);
        for (std::size_t c = 0; c < channels_; ++c)
          sum[light->replicate * channels_ + c] +=
              weight * static_cast<double>(rows_[light->row * channels_ + c]);
      }
  }
  std::vector<double> mean(channels_), limit(channels_);
  for (std::size_t pixel = 0; pixel < sums.size(); ++pixel) {
    if (sums[pixel].empty()) continue;
    double worst = 0.0;
    for (std::size_t c = 0; c < channels_; ++c) {
      const std::size_t at = pixel * channels_ + c;
      double sum = 0.0, squares = 0.0;
      for (std::size_t r = 0; r < kReplicates; ++r) sum += sums[pixel][r * channels_ + c];
      const double glint = sum / kReplicates;
      for (std::size_t r = 0; r < kReplicates; ++r) {
        const double off = sums[pixel][r * channels_ + c] - glint;
        squares += off * off;
      }
      mean[c] = static_cast<double>(tile.mean[at]) + glint;
      tile.mean[at] = static_cast<float>(mean[c]);
      if (!tile.has_errors()) continue;
      const double variance = squares / (kReplicates * (kReplicates - 1.0));
      const double student = sampling::two_sided_student(
          tolerance != nullptr ? tolerance->confidence() : 0.95, kReplicates - 1.0);
      tile.variance_path[at] += static_cast<float>(variance);
      tile.half_width[at] = static_cast<float>(
          std::hypot(static_cast<double>(tile.half_width[at]), student * std::sqrt(variance)));
    }
    if (tolerance == nullptr || !tile.has_errors()) continue;
    tolerance->limits(mean, limit);
    for (std::size_t c = 0; c < channels_; ++c)
      worst = std::max(worst, static_cast<double>(tile.half_width[pixel * channels_ + c]) / limit[c]);
    tile.worst_ratio[pixel] = static_cast<float>(worst);
    tile.set(pixel, sampling::Reason::error, worst > 1.0 + 1e-6);
  }
}

}  // namespace ifov::render
