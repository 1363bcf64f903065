#include "render/mirrors/highlights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world/surface_survey.h"
#include "radiometry/spectrum_block.h"
#include "sampling/random.h"
#include "transport/mirrors/sun_lobes.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

/// Points traced together.
constexpr std::size_t kTogether = 4096;

/// Channels of one highlight keep their proportions within this: they share a spectrum.
constexpr float kSameColour = 1e-4f;

constexpr std::uint64_t kHighlightPaths = 0x6869676877ull;

transport::TransportOptions highlights_alone() {
  transport::TransportOptions options;
  options.maximum_scatterings = 1;
  options.seek_emitters = false;
  options.mirror_reflections = 0;
  options.highlights = transport::TransportOptions::Highlights::alone;
  return options;
}

}  // namespace

bool Highlights::in(const transport::SpectralScene& scene) {
  if (scene.sun_lobes() == nullptr || scene.scene().world->period()) return false;
  const geometry::SurfaceSurvey& survey = scene.sun_lobes()->survey();
  return !survey.rounds.empty() || !survey.smooths.empty();
}

Highlights::Highlights(const transport::SpectralScene& scene, const sensor::Camera& camera, double margin_px,
                       std::uint64_t seed)
    : scene_(scene),
      camera_(camera),
      seed_(seed),
      tracer_(scene, highlights_alone()),
      light_(scene),
      air_(scene),
      lights_(scene.nodes().channel_count()) {
  const transport::SunLobes& lobes = *scene.sun_lobes();
  const scene::Sun& sun = *scene.scene().sun;
  const double reach =
      2.0 * std::atan(transport::SunLobes::kLastSlopes * lobes.slopes().most) + sun.half_angle_rad;
  GlintSearch search(camera, sun.direction, lobes.slopes().least, std::min(reach, std::numbers::pi),
                     margin_px, seed);
  std::vector<GlintPoint> points;
  const auto keep = [&](const GlintPoint& point) {
    points.push_back(point);
    if (points.size() == kTogether) trace(points);
  };
  std::uint64_t number = 0;
  for (const auto& round : lobes.survey().rounds) search.search(round, number++, keep);
  for (const auto& smooth : lobes.survey().smooths) search.search(smooth, number++, keep);
  trace(points);
  lights_.sort();
}

void Highlights::trace(std::vector<GlintPoint>& points) {
  std::vector<sampling::FocalPoint> images;
  std::vector<transport::PathKey> keys;
  const std::uint64_t sequence = sampling::hash(seed_, kHighlightPaths);
  for (const GlintPoint& point : points) {
    images.push_back(point.image);
    keys.push_back({sequence, static_cast<std::uint32_t>(traced_++)});
  }
  std::vector<math::Ray> rays(points.size());
  std::vector<geometry::SurfacePoint> hits(points.size());
  camera_.rays(images, rays);
  sampling::RayCounts counts;
  const transport::PathRecord& record = tracer_.trace(rays, keys, hits, counts);
  radiometry::SpectrumBlock nothing(1, scene_.node_count());
  std::vector<float> channels(std::max(scene_.stride(), scene_.nodes().channel_count()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    // What was searched must be what is seen.
    if (!hits[k].hit() || !scene_.sun_lobes()->by_shape(hits[k]) ||
        math::length(hits[k].position_m - points[k].at_m) > 1e-6 * (1.0 + hits[k].distance_m))
      continue;
    const std::uint32_t first = record.paths[k].first;
    if (first == transport::PathVertex::kNone || record.vertices[first].sun_weight <= 0.0f) continue;
    float* radiance = light_.first_sunlight(record, k);
    // Of what the air makes of light its own light is no part here.
    air_.apply(record.paths[k], radiance);
    std::fill_n(nothing.row(0), nothing.stride(), 0.0f);
    air_.apply(record.paths[k], nothing.row(0));
    for (std::size_t n = 0; n < nothing.stride(); ++n)
      radiance[n] = std::max(0.0f, radiance[n] - nothing.row(0)[n]);
    scene_.nodes().to_channels(radiance, channels.data());
    add(points[k], channels.data());
  }
  points.clear();
}

void Highlights::add(const GlintPoint& point, const float* channels) {
  const std::size_t count = scene_.nodes().channel_count();
  const float brightest = *std::max_element(channels, channels + count);
  if (!(brightest > 0.0f)) return;
  bool same = !spectrum_.empty();
  for (std::size_t c = 0; same && c < count; ++c)
    same = std::abs(channels[c] / brightest - spectrum_[c]) <= kSameColour * spectrum_[c];
  if (!same) {
    spectrum_.resize(count);
    for (std::size_t c = 0; c < count; ++c) spectrum_[c] = channels[c] / brightest;
    spectrum_number_ = lights_.add_spectrum(spectrum_);
  }
  lights_.add({point.image, static_cast<float>(point.area) * brightest, spectrum_number_, point.replicate});
}

}  // namespace ifov::render
