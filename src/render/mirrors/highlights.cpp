#include "render/mirrors/highlights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "geometry/world/surface_survey.h"
#include "render/mirrors/exposed_points.h"
#include "render/mirrors/sought_instants.h"
#include "render/polarized/scene_light.h"
#include "sampling/random.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/mirrors/sun_lobes.h"
#include "transport/path_tracer.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

/// Seconds of search; what is larger than that many pixels shows its highlights well enough.
constexpr std::size_t kMostTriangles = std::size_t{1} << 18;

/// Of triangles, where there are more things than have room. Most lie far from the highlight's middle, where little of its light is.
constexpr std::array<GlintSearch::Coarseness, 6> kCoarseness{
    {{1.0, 0.0}, {1.0, 0.5}, {1.4, 0.5}, {2.0, 0.5}, {2.8, 0.5}, {4.0, 0.5}}};

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
                       std::uint64_t seed, const LightTold& told)
    : scene_(scene),
      camera_(camera),
      seed_(seed),
      tracer_(std::make_unique<transport::PathTracer>(scene, highlights_alone())),
      light_(std::make_unique<SceneLight>(scene, camera, told)),
      lights_(light_->columns().count()) {
  find(seed, margin_px);
  lights_.sort();
}

std::vector<Highlights::Thing> Highlights::things() const {
  std::map<std::uint32_t, Thing> by_object;
  const geometry::SurfaceSurvey& survey = scene_.sun_lobes()->survey();
  const auto thing_of = [&](std::uint32_t object, const geometry::SurfaceSurvey::Ball& ball) -> Thing& {
    Thing& thing = by_object[object];
    thing.object = object;
    thing.radius_m = std::max(thing.radius_m, ball.radius_m);
    return thing;
  };
  for (std::size_t k = 0; k < survey.rounds.size(); ++k)
    thing_of(survey.rounds[k].object, survey.rounds[k].ball).rounds.push_back(k);
  for (std::size_t k = 0; k < survey.smooths.size(); ++k)
    thing_of(survey.smooths[k].object, survey.smooths[k].ball).smooths.push_back(k);
  std::vector<Thing> things;
  for (auto& [object, thing] : by_object) things.push_back(std::move(thing));
  std::stable_sort(things.begin(), things.end(),
                   [](const Thing& a, const Thing& b) { return a.radius_m < b.radius_m; });
  return things;
}

GlintSearch Highlights::search_for(const sensor::Camera& camera, const GlintSearch::Coarseness& coarse,
                                   double margin_px, std::uint64_t seed) const {
  const transport::SunLobes& lobes = *scene_.sun_lobes();
  return {camera,
          scene_.scene().sun->direction,
          lobes.slopes().least,
          lobes.seen_reach_rad(),
          coarse,
          margin_px,
          seed,
          kMostTriangles};
}

void Highlights::search(const Thing& thing, const geometry::SurfaceSurvey& survey, GlintSearch& search,
                        const GlintSearch::Found& found) {
  for (const std::size_t k : thing.rounds) search.search(survey.rounds[k], k, found);
  for (const std::size_t k : thing.smooths) search.search(survey.smooths[k], survey.rounds.size() + k, found);
}

bool Highlights::is_unsure_without(const Thing& thing) const {
  const transport::SunLobes& lobes = *scene_.sun_lobes();
  return !thing.smooths.empty() ||
         radius_px(lobes.survey().rounds[thing.rounds.front()].ball) * lobes.slopes().least < 1.0;
}

GlintSearch::Coarseness Highlights::coarseness(const sensor::Camera& camera, const std::vector<Thing>& things,
                                               double margin_px) const {
  GlintSearch::Coarseness best = kCoarseness.front();
  std::size_t fewest = things.size() + 1;
  for (const GlintSearch::Coarseness& coarse : kCoarseness) {
    GlintSearch count = search_for(camera, coarse, margin_px, 0);
    std::size_t unsure = 0;
    for (const Thing& thing : things) {
      search(thing, scene_.sun_lobes()->survey(), count, {});
      unsure += count.broken_off() && is_unsure_without(thing);
    }
    if (unsure < fewest) fewest = unsure, best = coarse;
    if (unsure == 0) break;
  }
  return best;
}

void Highlights::find(std::uint64_t seed, double margin_px) {
  const std::vector<Thing> things = this->things();
  const SoughtInstants instants(scene_.scene(), camera_, seed);
  const GlintSearch::Coarseness coarse = coarseness(instants.camera(instants.size() / 2), things, margin_px);
  std::vector<GlintSearch> searches;
  for (std::size_t k = 0; k < instants.size(); ++k)
    searches.push_back(search_for(instants.camera(k), coarse, margin_px, instants.seed(k)));
  std::vector<GlintPoint> points;
  for (const Thing& thing : things) {
    const std::size_t before = lights_.lights().size();
    bool broken_off = false;
    for (std::size_t k = 0; k < instants.size() && !broken_off; ++k) {
      Highlights::search(thing, scene_.sun_lobes()->survey(), searches[k], [&](const GlintPoint& point) {
        points.push_back(instants.point(k, point));
        if (points.size() == kTogether) trace(points);
      });
      trace(points);
      broken_off = searches[k].broken_off();
    }
    if (!broken_off) continue;
    lights_.keep(before);
    large_.push_back(thing.object);
    if (is_unsure_without(thing)) unsure_.push_back(thing.object);
  }
  std::sort(large_.begin(), large_.end());
  std::sort(unsure_.begin(), unsure_.end());
}

double Highlights::radius_px(const geometry::SurfaceSurvey::Ball& ball) const {
  double least = HUGE_VAL;
  sampling::FocalPoint middle, rim;
  for (const math::Vec3 step : {math::Vec3{1.0, 0.0, 0.0}, math::Vec3{0.0, 1.0, 0.0}}) {
    if (!camera_.project(ball.centre_m, middle) ||
        !camera_.project(ball.centre_m + ball.radius_m * step, rim))
      return 0.0;
    least = std::min(least, std::hypot(rim.x_px - middle.x_px, rim.y_px - middle.y_px));
  }
  return least;
}

Highlights::~Highlights() = default;

void Highlights::trace(std::vector<GlintPoint>& points) {
  spread_over_exposure(scene_.scene(), camera_, seed_, points);
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
  const transport::PathRecord& record = tracer_->trace(rays, keys, hits, counts);
  std::vector<float> channels(std::max(scene_.stride(), light_->columns().count()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    // What was searched must be what is seen.
    if (!hits[k].hit() || !scene_.sun_lobes()->by_shape(hits[k]) ||
        math::length(hits[k].position_m - points[k].at_m) > 1e-6 * (1.0 + hits[k].distance_m))
      continue;
    const std::uint32_t first = record.paths[k].first;
    if (first == transport::PathVertex::kNone || record.vertices[first].sun_weight <= 0.0f) continue;
    light_->write_sunlight(record, k, points[k].image, rays[k], channels.data());
    add(points[k], channels.data());
  }
  points.clear();
}

void Highlights::add(const GlintPoint& point, const float* channels) {
  const std::size_t count = light_->columns().count(), radiances = scene_.nodes().channel_count();
  const float brightest = *std::max_element(channels, channels + radiances);
  if (!(brightest > 0.0f)) return;
  bool same = !spectrum_.empty();
  for (std::size_t c = 0; same && c < count; ++c)
    same = std::abs(channels[c] / brightest - spectrum_[c]) <= kSameColour * spectrum_[c % radiances];
  if (!same) {
    spectrum_.resize(count);
    for (std::size_t c = 0; c < count; ++c) spectrum_[c] = channels[c] / brightest;
    spectrum_number_ = lights_.add_spectrum(spectrum_);
  }
  lights_.add({point.image, static_cast<float>(point.area) * brightest, spectrum_number_, point.replicate});
}

}  // namespace ifov::render
