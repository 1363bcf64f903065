#include "render/mirrors/mirror_images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "core/run_control.h"
#include "geometry/world.h"
#include "render/mirrors/exposed_points.h"
#include "render/polarized/scene_light.h"
#include "sampling/random.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/path_tracer.h"
#include "transport/shapes/round_mirror.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

using transport::SeparateImages;
using transport::ShiningParts;

namespace {

/// Points traced together.
constexpr std::size_t kBatch = 4096;
/// Steps across the half-angle of what is sought.
constexpr double kSteps = 16.0, kFewestSteps = 4.0;
/// About how many places of a mirror are looked at for a part at so many steps, beside those of a mesh.
constexpr double kUsualWork = 2e4;
/// Where there are more images they are searched more coarsely.
constexpr double kManyImages = 500.0;
constexpr std::uint64_t kImages = 0x6d6972726f72ull;

}  // namespace

std::unique_ptr<const MirrorImages> MirrorImages::find(const transport::SpectralScene& scene,
                                                       const sensor::Camera& camera,
                                                       const transport::TransportOptions& transport,
                                                       double margin_px, std::uint64_t seed, int threads,
                                                       const CancelToken* cancel, const LightTold& told) {
  if (scene.scene().world == nullptr || scene.scene().world->survey() == nullptr) return nullptr;
  std::unique_ptr<MirrorImages> images(new MirrorImages(scene, camera, told, seed));
  // UnseenImages asks what of the rest shines.
  const bool moving = scene.scene().world->moving() != nullptr;
  if (images->parts_.parts().empty() && images->parts_.complete() && !moving) return nullptr;
  images->list_mirrors();
  std::vector<Pair> pairs = images->pairs();
  double work = 0.0;
  std::size_t kept = 0;
  while (kept < pairs.size() && (work += pairs[kept].work) <= kMostWork) ++kept;
  images->all_settled_ = kept == pairs.size() && images->apart_.any();
  pairs.resize(kept);
  std::vector<Found> found(pairs.size());
  const auto count = static_cast<std::int64_t>(pairs.size());
  const auto key = [seed](std::int64_t pair) { return sampling::hash(seed, kImages, pair); };
  parallel_for(count, threads, [&](std::int64_t k) {
    if (cancel != nullptr && cancel->cancelled()) throw Cancelled();
    const auto at = static_cast<std::size_t>(k);
    found[at] = images->search(pairs[at], margin_px, key(k));
  });
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const SeparateImages::Mirror mirror = images->mirrors_[pairs[k].mirror].name;
    const std::uint32_t object = images->parts_.parts()[pairs[k].first].object;
    if (found[k].outcome == Outcome::given_up) {
      images->all_settled_ = false;
      continue;
    }
    images->settled_.push_back({mirror, object});
    if (!found[k].places.empty()) images->met_.push_back(std::move(found[k].places));
    if (!found[k].rows.empty()) images->apart_.add(mirror, object);
  }
  images->apart_.finish();
  std::sort(images->settled_.begin(), images->settled_.end());
  std::vector<std::optional<FocalLights>> lights(pairs.size());
  parallel_for(count, threads, [&](std::int64_t k) {
    if (cancel != nullptr && cancel->cancelled()) throw Cancelled();
    const auto at = static_cast<std::size_t>(k);
    if (!found[at].rows.empty()) lights[at].emplace(images->weigh(transport, key(k), found[at].rows));
  });
  for (const std::optional<FocalLights>& light : lights)
    if (light) images->lights_.append(*light);
  images->lights_.sort();
  return images;
}

MirrorImages::MirrorImages(const transport::SpectralScene& scene, const sensor::Camera& camera,
                           const LightTold& told, std::uint64_t seed)
    : scene_(scene),
      camera_(camera),
      instants_(scene.scene(), camera, seed),
      told_(told),
      parts_(scene),
      apart_(scene.scene(), parts_),
      lights_(StokesColumns(told, scene.nodes()).count()) {}

bool MirrorImages::settled(SeparateImages::Mirror mirror, std::uint32_t object) const {
  return std::binary_search(settled_.begin(), settled_.end(), Name{mirror, object});
}

void MirrorImages::list_mirrors() {
  if (!apart_.any()) return;
  const geometry::SurfaceSurvey& survey = *scene_.scene().world->survey();
  std::map<std::uint32_t, Mirror> curved;  // by object
  for (std::size_t k = 0; k < survey.rounds.size(); ++k) curved[survey.rounds[k].object].rounds.push_back(k);
  for (std::size_t k = 0; k < survey.smooths.size(); ++k) {
    Mirror& mirror = curved[survey.smooths[k].object];
    mirror.smooths.push_back(k);
    mirror.triangles += survey.smooths[k].triangles.size();
  }
  for (auto& [object, mirror] : curved) {
    mirror.name = SeparateImages::curved(object);
    mirrors_.push_back(std::move(mirror));
  }
  for (std::size_t k = 0; k < apart_.planes().size(); ++k) {
    mirrors_.emplace_back();
    mirrors_.back().name = SeparateImages::flat(k);
  }
}

std::vector<MirrorImages::Pair> MirrorImages::pairs() {
  std::vector<Pair> pairs;
  const std::span<const ShiningParts::Part> parts = parts_.parts();
  for (std::size_t first = 0; first < parts.size();) {
    std::size_t last = first;
    while (last < parts.size() && parts[last].object == parts[first].object) ++last;
    for (std::size_t m = 0; m < mirrors_.size(); ++m) {
      const bool matters =
          std::any_of(parts.begin() + static_cast<std::ptrdiff_t>(first),
                      parts.begin() + static_cast<std::ptrdiff_t>(last),
                      [&](const ShiningParts::Part& part) { return may_matter(mirrors_[m], part); });
      if (!matters) {
        settled_.push_back({mirrors_[m].name, parts[first].object});
        continue;
      }
      pairs.push_back({m, first, last});
    }
    first = last;
  }
  // Many parts tell of one thing together, and many images of one scene.
  double images = 0.0;
  for (const Pair& pair : pairs) images += std::sqrt(static_cast<double>(pair.last - pair.first));
  const double finest = kSteps * std::min(1.0, std::sqrt(kManyImages / images));
  for (Pair& pair : pairs) {
    const auto count = static_cast<double>(pair.last - pair.first);
    pair.steps = std::max(kFewestSteps, finest / std::sqrt(count));
    pair.work = static_cast<double>(instants_.size()) * count *
                (kUsualWork * std::pow(pair.steps / kSteps, 2) +
                 3.0 * static_cast<double>(mirrors_[pair.mirror].triangles));
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.work < b.work; });
  return pairs;
}

/// By the largest image that there can be: light from all directions fills the whole outline of a sphere alike, so that a
/// part of solid angle W at its nearest fills W / 4 pi of it.
bool MirrorImages::may_matter(const Mirror& mirror, const ShiningParts::Part& part) const {
  if (!mirror.smooths.empty() || mirror.rounds.empty()) return true;
  const geometry::SurfaceSurvey& survey = *scene_.scene().world->survey();
  double area_px2 = 0.0;
  for (const std::size_t k : mirror.rounds) {
    const geometry::SurfaceSurvey::Round& round = survey.rounds[k];
    const math::Vec3 x = round.scene_from_unit.column_x();
    const double radius = length(x);
    if (round.kind != geometry::UnitKind::sphere || !transport::RoundMirror::of(round)) return true;
    const math::Point3 centre = round.scene_from_unit.origin_m();
    const double nearest = length(part.ball.centre_m - centre) - radius;
    if (nearest < 2.0 * part.ball.radius_m) return true;
    sampling::FocalPoint image;
    if (!camera_.project(centre, image)) return true;
    const double outline = std::numbers::pi * std::pow(radius / camera_.gsd_m(centre), 2);
    area_px2 += outline * 0.25 * std::pow(part.ball.radius_m / nearest, 2);
  }
  constexpr double kPerspective = 4.0;  // what a near camera makes of it
  return kPerspective * area_px2 * part.contrast > kNegligible;
}

MirrorImages::Found MirrorImages::search(const Pair& pair, double margin_px, std::uint64_t key) const {
  Found found;
  const Mirror& mirror = mirrors_[pair.mirror];
  const geometry::SurfaceSurvey& survey = *scene_.scene().world->survey();
  std::vector<FocalLights::Light> seen;
  std::vector<GlintPoint> points;
  for (std::size_t p = pair.first; p < pair.last; ++p) {
    const ShiningParts::Part& part = parts_.parts()[p];
    bool broken_off = false;
    for (std::size_t i = 0; i < instants_.size(); ++i) {
      GlintSearch search(instants_.camera(i), part.ball, margin_px, pair.steps / std::sqrt(part.fill),
                         instants_.size() == 1 ? key : sampling::hash(key, i), kMostTriangles);
      const auto keep = [&](const GlintPoint& point) {
        points.push_back(instants_.point(i, point));
        if (points.size() == kBatch) trace(mirror, static_cast<std::uint32_t>(p), points, seen);
      };
      for (const std::size_t k : mirror.rounds) search.search(survey.rounds[k], p, keep);
      for (const std::size_t k : mirror.smooths) search.search(survey.smooths[k], p, keep);
      if (mirror.rounds.empty() && mirror.smooths.empty()) {
        const SeparateImages::Plane& plane =
            apart_.planes()[static_cast<std::size_t>(mirror.name & 0xffffffffu)];
        search.search(plane.normal, plane.offset_m, p, keep);
      }
      trace(mirror, static_cast<std::uint32_t>(p), points, seen);
      broken_off = broken_off || search.broken_off();
    }
    if (!broken_off) continue;
    found.outcome = met_by_paths(seen) ? Outcome::met : Outcome::given_up;
    if (found.outcome == Outcome::met) found.places = places_of(seen);
    return found;
  }
  if (met_by_paths(seen)) {
    found.outcome = Outcome::met;
    found.places = places_of(seen);
  } else {
    found.rows = image_spectra(seen, key);
  }
  return found;
}

void MirrorImages::trace(const Mirror& mirror, std::uint32_t part, std::vector<GlintPoint>& points,
                         std::vector<FocalLights::Light>& seen) const {
  const scene::Scene& scene = scene_.scene();
  spread_over_exposure(scene, camera_, part, points);
  std::vector<sampling::FocalPoint> images;
  for (const GlintPoint& point : points) images.push_back(point.image);
  std::vector<math::Ray> rays(points.size()), onward;
  std::vector<geometry::SurfacePoint> hits(points.size());
  camera_.rays(images, rays);
  scene.world->intersect(rays, hits);
  std::vector<std::size_t> legs;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const geometry::SurfacePoint& hit = hits[k];
    if (!hit.hit()) continue;
    const math::Vec3 normal = scene.resolve(hit).shading_normal.as_vector(), view = rays[k].direction;
    if (apart_.mirror_of(hit, normal) != mirror.name) continue;
    // What was searched must be what is seen.
    if (length(hit.position_m - points[k].at_m) > 1e-6 * (1.0 + hit.distance_m)) continue;
    const math::Vec3 from = math::normalized(view - 2.0 * dot(view, normal) * normal);
    const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
    if (!(dot(from, outward) > 0.0)) continue;
    legs.push_back(k);
    onward.push_back(rays[k].onward(hit.position_m + hit.offset_m * outward, from));
  }
  std::vector<geometry::SurfacePoint> met(onward.size());
  scene.world->intersect(onward, met);
  for (std::size_t j = 0; j < legs.size(); ++j) {
    if (!met[j].hit() || !parts_.shines(met[j]) || parts_.part_of(met[j]) != part) continue;
    const GlintPoint& point = points[legs[j]];
    seen.push_back({point.image, static_cast<float>(point.area), 0, point.replicate});
  }
  points.clear();
}

FocalLights MirrorImages::weigh(transport::TransportOptions transport, std::uint64_t key,
                                const std::vector<ImageSpectrum>& rows) const {
  SceneLight light(scene_, camera_, told_);
  const std::size_t channels = light.columns().count();
  FocalLights lights(channels);
  transport.separate_images = nullptr;
  transport::PathTracer all(scene_, transport);
  transport.separate_images = &apart_;
  transport::PathTracer without_images(scene_, transport);
  struct Sum {
    double area = 0.0;
    std::vector<double> of;
  };
  std::vector<Sum> sums(rows.size());
  struct Point {
    std::size_t row;
    const FocalLights::Light* seen;
  };
  std::vector<Point> points;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    sums[r].of.assign(channels, 0.0);
    for (const FocalLights::Light& point : rows[r].told_by) points.push_back({r, &point});
  }
  std::vector<sampling::FocalPoint> images;
  std::vector<math::Ray> rays;
  std::vector<transport::PathKey> keys;
  std::vector<geometry::SurfacePoint> hits;
  std::vector<float> row(std::max(channels, scene_.stride()));
  sampling::RayCounts counts;
  for (std::size_t first = 0; first < points.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, points.size() - first);
    images.resize(count), rays.resize(count), keys.resize(count), hits.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      images[k] = points[first + k].seen->at;
      keys[k] = {key, static_cast<std::uint32_t>(first + k)};
    }
    camera_.rays(images, rays);
    for (transport::PathTracer* tracer : {&all, &without_images}) {
      const double sign = tracer == &all ? 1.0 : -1.0;
      const transport::PathRecord& paths = tracer->trace(rays, keys, hits, counts);
      for (std::size_t k = 0; k < count; ++k) {
        light.write(paths, k, images[k], rays[k], row.data());
        Sum& sum = sums[points[first + k].row];
        const auto area = static_cast<double>(points[first + k].seen->per_radiance);
        if (tracer == &all) sum.area += area;
        for (std::size_t c = 0; c < channels; ++c) sum.of[c] += sign * area * static_cast<double>(row[c]);
      }
    }
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < channels; ++c) row[c] = static_cast<float>(sums[r].of[c] / sums[r].area);
    const std::uint32_t number = lights.add_spectrum(row);
    for (FocalLights::Light point : rows[r].lights) {
      point.spectrum = number;
      lights.add(point);
    }
  }
  return lights;
}

std::vector<MirrorImages::Place> MirrorImages::places_of(const std::vector<FocalLights::Light>& seen) {
  // Points lie closer together than squares are wide: what is between them, and about them, is in a neighbour.
  std::vector<Place> places;
  for (const FocalLights::Light& light : seen) {
    const auto row = static_cast<std::int32_t>(std::floor(light.at.y_px / kPlace_px)),
               column = static_cast<std::int32_t>(std::floor(light.at.x_px / kPlace_px));
    for (std::int32_t j = -1; j <= 1; ++j)
      for (std::int32_t i = -1; i <= 1; ++i) places.emplace_back(row + j, column + i);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

std::vector<sampling::FocalPoint> MirrorImages::places(double most_px) const {
  std::vector<Place> all;
  for (const std::vector<Place>& places : met_) {
    const auto [left, right] = std::minmax_element(
        places.begin(), places.end(), [](const Place& a, const Place& b) { return a.second < b.second; });
    const std::int32_t across = right->second - left->second,
                       down = places.back().first - places.front().first;
    if (kPlace_px * std::max(across, down) <= most_px) all.insert(all.end(), places.begin(), places.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::vector<sampling::FocalPoint> middles;
  for (const auto& [row, column] : all)
    middles.push_back({kPlace_px * (column + 0.5), kPlace_px * (row + 0.5)});
  return middles;
}

bool MirrorImages::met_by_paths(const std::vector<FocalLights::Light>& seen) const {
  std::map<std::pair<int, int>, double> pixels;
  double area = 0.0;
  for (const FocalLights::Light& light : seen) {
    const double part = static_cast<double>(light.per_radiance) / FocalLights::kReplicates;
    pixels[{static_cast<int>(std::floor(light.at.x_px)), static_cast<int>(std::floor(light.at.y_px))}] +=
        part;
    area += part;
  }
  return area > kMet * static_cast<double>(pixels.size());
}

}  // namespace ifov::render
