#include "render/mirror_images.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "core/parallel.h"
#include "geometry/world.h"
#include "render/mirrored_rows.h"

namespace ifov::render {

using transport::ImagesApart;
using transport::ShiningParts;

namespace {

/// Points traced together.
constexpr std::size_t kBatch = 4096;
/// Steps across the half-angle of what is looked for.
constexpr double kSteps = 16.0;
/// About how many places of a mirror are looked at for a part, beside those of a mesh.
constexpr double kUsualWork = 2e4;

}  // namespace

std::unique_ptr<const MirrorImages> MirrorImages::find(const transport::SpectralScene& scene,
                                                       const sensor::Camera& camera, double margin_px,
                                                       std::uint64_t seed, int threads) {
  if (scene.scene().world == nullptr || scene.scene().world->survey() == nullptr) return nullptr;
  std::unique_ptr<MirrorImages> images(new MirrorImages(scene, camera));
  if (images->parts_.parts().empty() && images->parts_.complete()) return nullptr;
  images->list_mirrors();
  std::vector<Pair> pairs = images->pairs();
  double work = 0.0;
  std::size_t kept = 0;
  while (kept < pairs.size() && (work += pairs[kept].work) <= kMostWork) ++kept;
  images->all_settled_ = kept == pairs.size() && images->apart_.any();
  pairs.resize(kept);
  std::vector<std::optional<Found>> found(pairs.size());
  parallel_for(static_cast<std::int64_t>(pairs.size()), threads, [&](std::int64_t k) {
    const auto at = static_cast<std::size_t>(k);
    found[at].emplace(images->look(pairs[at], margin_px, seed, at));
  });
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const ImagesApart::Mirror mirror = images->mirrors_[pairs[k].mirror].name;
    const std::uint32_t object = images->parts_.parts()[pairs[k].first].object;
    if (found[k]->outcome == Outcome::given_up) {
      images->all_settled_ = false;
      continue;
    }
    images->settled_.push_back({mirror, object});
    if (found[k]->outcome == Outcome::met || found[k]->lights.lights().empty()) continue;
    images->apart_.add(mirror, object);
    images->lights_.append(found[k]->lights);
  }
  images->apart_.finish();
  std::sort(images->settled_.begin(), images->settled_.end());
  images->lights_.sort();
  return images;
}

MirrorImages::MirrorImages(const transport::SpectralScene& scene, const sensor::Camera& camera)
    : scene_(scene),
      camera_(camera),
      parts_(scene),
      apart_(scene.scene(), parts_),
      lights_(scene.nodes().channel_count()) {}

bool MirrorImages::settled(ImagesApart::Mirror mirror, std::uint32_t object) const {
  return std::binary_search(settled_.begin(), settled_.end(), Name{mirror, object});
}

void MirrorImages::list_mirrors() {
  if (!apart_.any()) return;
  const geometry::SurfaceSurvey& survey = *scene_.scene().world->survey();
  std::map<std::uint32_t, Mirror> bent;  // by object
  for (std::size_t k = 0; k < survey.rounds.size(); ++k) bent[survey.rounds[k].object].rounds.push_back(k);
  for (std::size_t k = 0; k < survey.smooths.size(); ++k) {
    Mirror& mirror = bent[survey.smooths[k].object];
    mirror.smooths.push_back(k);
    mirror.triangles += survey.smooths[k].triangles.size();
  }
  for (auto& [object, mirror] : bent) {
    mirror.name = ImagesApart::bent(object);
    mirrors_.push_back(std::move(mirror));
  }
  for (std::size_t k = 0; k < apart_.planes().size(); ++k) {
    mirrors_.emplace_back();
    mirrors_.back().name = ImagesApart::flat(k);
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
      const double work = kUsualWork + 3.0 * static_cast<double>(mirrors_[m].triangles);
      pairs.push_back({m, first, last, work * static_cast<double>(last - first)});
    }
    first = last;
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

MirrorImages::Found MirrorImages::look(const Pair& pair, double margin_px, std::uint64_t seed,
                                       std::uint64_t number) const {
  Found found{Outcome::apart, FocalLights(scene_.nodes().channel_count())};
  const Mirror& mirror = mirrors_[pair.mirror];
  const geometry::SurfaceSurvey& survey = *scene_.scene().world->survey();
  std::vector<FocalLights::Light> seen;
  std::vector<GlintPoint> points;
  for (std::size_t p = pair.first; p < pair.last; ++p) {
    const ShiningParts::Part& part = parts_.parts()[p];
    GlintSearch search(camera_, part.ball, margin_px, kSteps / std::sqrt(part.fill), seed ^ 0x6d6972726f72ull,
                       kMostTriangles);
    const auto keep = [&](const GlintPoint& point) {
      points.push_back(point);
      if (points.size() == kBatch) trace(mirror, static_cast<std::uint32_t>(p), points, found.lights, seen);
    };
    const std::uint64_t name = number << 32 | p;
    for (const std::size_t k : mirror.rounds) search.search(survey.rounds[k], name, keep);
    for (const std::size_t k : mirror.smooths) search.search(survey.smooths[k], name, keep);
    if (mirror.rounds.empty() && mirror.smooths.empty()) {
      const ImagesApart::Plane& plane = apart_.planes()[static_cast<std::size_t>(mirror.name & 0xffffffffu)];
      search.search(plane.normal, plane.offset_m, name, keep);
    }
    trace(mirror, static_cast<std::uint32_t>(p), points, found.lights, seen);
    if (!search.broken_off()) continue;
    found.outcome = met_by_paths(seen) ? Outcome::met : Outcome::given_up;
    return found;
  }
  if (met_by_paths(seen)) found.outcome = Outcome::met;
  for (const FocalLights::Light& light : seen) found.lights.add(light);
  return found;
}

void MirrorImages::trace(const Mirror& mirror, std::uint32_t part, std::vector<GlintPoint>& points,
                         FocalLights& lights, std::vector<FocalLights::Light>& seen) const {
  const scene::Scene& scene = scene_.scene();
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
    const scene::ResolvedSurface surface = scene.resolve(hit);
    const math::Vec3 normal = surface.shading_normal.as_vector(), view = rays[k].direction;
    if (apart_.mirror_of(hit, normal) != mirror.name) continue;
    // What was searched must be what is seen.
    if (length(hit.position_m - points[k].at_m) > 1e-6 * (1.0 + hit.distance_m)) continue;
    const math::Vec3 from = math::normalized(view - 2.0 * dot(view, normal) * normal);
    const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
    if (!(dot(from, outward) > 0.0)) continue;
    legs.push_back(k);
    onward.push_back({hit.position_m + hit.offset_m * outward, from});
  }
  std::vector<geometry::SurfacePoint> met(onward.size());
  scene.world->intersect(onward, met);
  MirroredRows rows(scene_);
  radiometry::SpectrumBlock scratch(3, scene_.node_count());
  // Parts of one state in mirrors of one state share a row.
  std::uint64_t last_states = ~std::uint64_t{0};
  std::uint32_t row = 0;
  for (std::size_t j = 0; j < legs.size(); ++j) {
    if (!met[j].hit() || !parts_.shines(met[j]) || parts_.part_of(met[j]) != part) continue;
    const scene::ResolvedSurface thing = scene.resolve(met[j]), surface = scene.resolve(hits[legs[j]]);
    const bool alike = !scene_.is_mixed(thing) && surface.count == 1 && scene_.view_table() == nullptr;
    const std::uint64_t states =
        static_cast<std::uint64_t>(thing.constituents[0].state) << 32 | surface.constituents[0].state;
    if (!alike || states != last_states) {
      const float* light = scene_.emission(thing, -onward[j].direction, scratch.row(0));
      if (light == nullptr) continue;
      row =
          lights.add_row(rows.channels(surface, hits[legs[j]].position_m.z, -rays[legs[j]].direction, light));
      last_states = alike ? states : ~std::uint64_t{0};
    }
    const GlintPoint& point = points[legs[j]];
    seen.push_back({point.image, static_cast<float>(point.area), row, point.replicate});
  }
  points.clear();
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
