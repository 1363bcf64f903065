#include "render/unseen/unseen_lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world.h"
#include "materials/bsdf/narrow_lobes.h"
#include "render/mirrors/sought_instants.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/unseen/unseen_lobe_rays.h"
#include "render/unseen/widen_unseen.h"
#include "sampling/random.h"
#include "sampling/warp.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/emitters.h"
#include "transport/mirrors/sun_mirrors.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

using math::Point3;
using math::Vec3;

namespace {

/// Rays of the lattice along a side of a pixel.
constexpr int kLatticeAcross = 3;
/// How far directions between the lattice's may lie beyond them, over their spread (UnseenImages').
constexpr double kBeyondLattice = 1.2;
/// Spread of directions that say nothing of what lies between them.
constexpr double kNothingKnown = 2.0;
/// Of the usual radiance: what counts for nothing.
constexpr double kLeastShown = 1e-4;
/// Mirrors and narrow lobes that are followed, one behind another.
constexpr std::uint64_t kMostLevels = 3;
/// Rays of a surface towards what throws light.
constexpr std::uint64_t kThrownRays = 4;
/// Slope that lobes are widened to so that these rays find what bends (SunLobes::kWidenedSlope), and for what is flat, over the root of
/// the solid angle that they are sent into: a tenth of them then find the lobe.
constexpr double kWideSlope = 0.3, kFlatSlope = 0.15;
constexpr std::uint64_t kThrownChoice = 0x7468726f776eull;

}  // namespace

std::unique_ptr<const UnseenLobes> UnseenLobes::find(const transport::SpectralScene& scene,
                                                     const sensor::Camera& camera, std::uint64_t seed) {
  const std::vector<materials::Material>& materials = scene.scene().materials;
  const bool moving = scene.scene().world->moving() != nullptr;
  if (scene.emitters() == nullptr || !(scene.emitters()->outshine() || moving) ||
      scene.scene().world->lobe_survey() == nullptr ||
      std::none_of(materials.begin(), materials.end(),
                   [](const materials::Material& m) { return materials::throws_rarely(*m.bsdf); }))
    return nullptr;
  std::unique_ptr<const UnseenLobes> unseen(new UnseenLobes(scene, camera, seed));
  if (!scene.emitters()->outshine() && !unseen->moving_.any()) return nullptr;
  return unseen;
}

UnseenLobes::UnseenLobes(const transport::SpectralScene& scene, const sensor::Camera& camera,
                         std::uint64_t seed)
    : scene_(scene),
      camera_(camera),
      seed_(sampling::hash(seed, kThrownChoice)),
      parts_(scene),
      moving_(scene.scene(), camera, parts_),
      targets_(still_targets(scene.scene(), parts_)),
      shift_x_(sampling::unit_double(sampling::hash(seed_, 1)) / kLatticeAcross),
      shift_y_(sampling::unit_double(sampling::hash(seed_, 2)) / kLatticeAcross) {
  const geometry::SurfaceSurvey& survey = *scene.scene().world->lobe_survey();
  std::vector<geometry::SurfaceSurvey::Ball> balls = survey.balls;
  for (const auto& face : survey.faces) balls.push_back(face.ball);
  for (const auto& round : survey.rounds) balls.push_back(round.ball);
  const std::vector<geometry::SurfaceSurvey::Ball> groups = transport::SunMirrors::grouped(std::move(balls));
  for (const Vec3 moved : copies_about(scene.scene()))
    for (const auto& group : groups) throwers_.push_back({at_home(group.centre_m) + moved, group.radius_m});
}

std::vector<UnseenLobes::Met> UnseenLobes::follow(Rays& rays, const std::vector<Met>* before,
                                                  std::size_t places, sampling::RayCounts& counts) const {
  std::vector<Met> level(places);
  std::vector<geometry::SurfacePoint> hits(rays.rays.size());
  scene_.scene().world->intersect(rays.rays, hits);
  (before == nullptr ? counts.primary : counts.continuation) += hits.size();
  std::size_t kept = 0;
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const std::size_t place = rays.places[k];
    Met& here = level[place] = met(rays.rays[k], hits[k]);
    if (before != nullptr) {
      here.way = sampling::hash((*before)[place].way, here.way);
      here.brightness = (*before)[place].brightness * ((*before)[place].mirrored + (*before)[place].narrow);
    }
    if (!here.any || !(here.mirrored + here.narrow > 0.0) || !(dot(here.onward, here.outward) > 0.0))
      continue;
    rays.rays[kept] = rays.rays[k].onward(here.at, here.onward);
    rays.places[kept++] = place;
  }
  rays.rays.resize(kept);
  rays.places.resize(kept);
  return level;
}

void UnseenLobes::add_highlights(const std::vector<Met>& level, const Grid& grid, ShiningTargets& targets,
                                 Told& told, sampling::RayCounts& counts) const {
  for (int j = 0; j < kLatticeAcross * grid.height; ++j)
    for (int i = 0; i < kLatticeAcross * grid.width; ++i) {
      const Met& here = level[grid.place(i, j)];
      if (!here.any || !(here.narrow > 0.0)) continue;
      const std::size_t pixel = grid.pixel(i, j);
      if (!parts_.complete()) told.unknown[pixel] = 1;
      const Met* beside[4] = {grid.at(level, i - 1, j), grid.at(level, i + 1, j), grid.at(level, i, j - 1),
                              grid.at(level, i, j + 1)};
      for (const ShiningTarget& target : targets.at(here.time_s)) {
        const transport::ShiningParts::Part& part = target.part;
        const double away = std::max(length(target.centre_m - at_home(here.at)), part.ball.radius_m);
        double spread[2] = {-1.0, -1.0};
        for (int k = 0; k < 4; ++k)
          if (beside[k] != nullptr && beside[k]->any && beside[k]->way == here.way)
            spread[k / 2] = std::max(spread[k / 2], length(beside[k]->onward - here.onward) +
                                                        length(beside[k]->at - here.at) / away);
        for (int k = 0; k < 2; ++k)
          if (spread[k] < 0.0) spread[k] = spread[1 - k] < 0.0 ? kNothingKnown : spread[1 - k];
        const double core = std::asin(std::min(1.0, part.ball.radius_m / away)) + 2.0 * here.slope;
        double fills_px2 = 1.0;
        for (const double wide : spread)
          fills_px2 *= std::min(1.0, 2.0 * core / (kLatticeAcross * std::max(wide, 1e-9)));
        fills_px2 *= target.of_time() * grid.of_time;
        if (fills_px2 > kMet_px2 || fills_px2 * told.paths[pixel] > kKnown) continue;
        const double widest = std::min(kNothingKnown, std::max(spread[0], spread[1]));
        const double share = target.of_time() * grid.of_time * here.brightness *
                             shown(here, target, 0.5 * kBeyondLattice * widest);
        if (!(share * part.contrast > kLeastShown) || !is_free(here, target, counts)) continue;
        told.add(told.highlights, pixel, share / (kLatticeAcross * kLatticeAcross),
                 parts_.highest(part.assignment));
      }
    }
}

void UnseenLobes::add_thrown(const std::vector<Met>& level, std::uint64_t number, const Grid& grid,
                             ShiningTargets& targets, Told& told, sampling::RayCounts& counts) const {
  struct Sent {
    std::size_t pixel;
    double weight, flat_slope, spread;
  };
  std::vector<Sent> sent;
  std::vector<math::Ray> rays;
  std::vector<double> views(throwers_.size());
  for (int j = 0; j < kLatticeAcross * grid.height; ++j)
    for (int i = 0; i < kLatticeAcross * grid.width; ++i) {
      const Met& here = level[grid.place(i, j)];
      if (!here.any || !(here.spread > 0.0)) continue;
      const Point3 at = at_home(here.at);
      double all = 0.0;
      for (std::size_t k = 0; k < throwers_.size(); ++k) {
        const double apart = length(throwers_[k].centre_m - at), radius = throwers_[k].radius_m;
        all += views[k] = apart > radius ? radius * radius / (apart * apart) : 1.0;
      }
      for (std::uint64_t ray = 0; ray < kThrownRays && all > 0.0; ++ray) {
        const auto random = [&](std::uint64_t which) {
          return sampling::unit_double(sampling::hash(
              seed_, grid.name(i, j), (number * kThrownRays + ray) * 3 + which, kThrownChoice));
        };
        double position = random(0) * all;
        std::size_t picked = 0;
        while (picked + 1 < views.size() && position >= views[picked]) position -= views[picked++];
        const Vec3 towards = throwers_[picked].centre_m - at;
        const double sine = throwers_[picked].radius_m / std::max(length(towards), 1e-300);
        const bool inside = sine >= 1.0;
        const sampling::UniformCone cone(inside ? 0.5 * std::numbers::pi : std::asin(sine));
        const Vec3 direction =
            cone.sample(inside ? here.outward : towards / length(towards), {random(1), random(2)});
        const double side = dot(direction, here.outward);
        if (!(side > 0.0) && !here.passes) continue;
        const Point3 from = side > 0.0 ? at : at - 2.0 * length(here.at - here.surface_at) * here.outward;
        sent.push_back({grid.pixel(i, j),
                        grid.of_time * here.brightness * here.spread * std::abs(dot(here.normal, direction)) *
                            cone.solid_angle_sr() * all / views[picked] /
                            (std::numbers::pi * kThrownRays * kLatticeAcross * kLatticeAcross),
                        kFlatSlope * std::sqrt(cone.solid_angle_sr()), here.brightness * here.spread});
        rays.push_back({.origin_m = from, .direction = direction, .time_s = here.time_s});
      }
    }
  std::vector<geometry::SurfacePoint> hits(rays.size());
  scene_.scene().world->intersect(rays, hits);
  counts.shadow += rays.size();
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const Met thrower = met(rays[k], hits[k]);
    if (!thrower.any || !(thrower.narrow > 0.0)) continue;
    if (!parts_.complete()) told.unknown[sent[k].pixel] = 1;
    double found = 0.0;  // as a path finds it
    for (const ShiningTarget& target : targets.at(thrower.time_s)) {
      const transport::ShiningParts::Part& part = target.part;
      const double wide = target.of_time() * shown(thrower, target, kWideSlope),
                   flat = target.of_time() * shown(thrower, target, std::min(kWideSlope, sent[k].flat_slope));
      if (!(std::max(wide, flat) * sent[k].weight * part.contrast > kLeastShown) ||
          !is_free(thrower, target, counts))
        continue;
      if (target.moving != nullptr) {
        told.add(told.moving_wide, sent[k].pixel, sent[k].weight * wide, parts_.highest(part.assignment));
        told.add(told.moving_flat, sent[k].pixel, sent[k].weight * flat, parts_.highest(part.assignment));
        continue;
      }
      found += part.contrast * shown(thrower, target, 0.0);
      told.add(told.thrown_wide, sent[k].pixel, sent[k].weight * wide, parts_.highest(part.assignment));
      told.add(told.thrown_flat, sent[k].pixel, sent[k].weight * flat, parts_.highest(part.assignment));
    }
    told.first_moment[sent[k].pixel] += sent[k].weight * found;
    told.second_moment[sent[k].pixel] += sent[k].weight * sent[k].spread * found * found;
  }
}

void UnseenLobes::settle(const AccuracyTolerance* tolerance, sampling::TileResult& tile) const {
  if (tolerance == nullptr || !tile.has_errors()) return;
  Grid grid{tile.tile, tile.tile.width(), tile.tile.height(), 1.0};
  std::vector<sampling::FocalPoint> points;
  for (int j = 0; j < grid.rows(); ++j)
    for (int i = 0; i < grid.columns(); ++i)
      points.push_back({tile.tile.x0 + shift_x_ + (i - 0.5) / kLatticeAcross,
                        tile.tile.y0 + shift_y_ + (j - 0.5) / kLatticeAcross});
  Told told(static_cast<std::size_t>(tile.tile.count()), scene_.nodes().channel_count());
  for (std::size_t p = 0; p < told.paths.size(); ++p)
    told.paths[p] = static_cast<double>(tile.radiance_evaluations[p]);
  ShiningTargets targets(moving_, targets_);
  const std::vector<double> times_s = lattice_times_s(camera_);
  grid.of_time = 1.0 / static_cast<double>(times_s.size());
  for (const double time_s : times_s) {
    for (sampling::FocalPoint& point : points) point.time_s = time_s;
    Rays rays;
    rays.rays.resize(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) rays.places.push_back(k);
    camera_.rays(points, rays.rays);
    std::vector<Met> level, before;
    for (std::uint64_t number = 0; number < kMostLevels && !rays.rays.empty(); ++number) {
      before = std::move(level);
      level = follow(rays, number > 0 ? &before : nullptr, points.size(), tile.rays);
      add_highlights(level, grid, targets, told, tile.rays);
      add_thrown(level, number, grid, targets, told, tile.rays);
    }
  }
  std::vector<double> more(told.channels);
  UnseenWidening widening(*tolerance, told.channels, kNegligible);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      const auto pixel = static_cast<std::size_t>(y * grid.width + x);
      const auto around = [&](std::span<const double> what, std::size_t per_pixel, std::size_t c) {
        return mean_about(what, per_pixel, c, x, y, grid.width, grid.height);
      };
      const double first = around(told.first_moment, 1, 0), second = around(told.second_moment, 1, 0);
      // As many paths as if each of them found all or nothing of it.
      const bool known = told.paths[pixel] * first * first > kKnown * second && second > 0.0;
      for (std::size_t c = 0; c < told.channels; ++c) {
        const auto most = [&](const std::vector<double>& what) {
          return std::max(what[pixel * told.channels + c], around(what, told.channels, c));
        };
        const double thrown = known ? 0.0 : std::max(most(told.thrown_wide), most(told.thrown_flat));
        more[c] = kCaution *
                  (most(told.highlights) + thrown + std::max(most(told.moving_wide), most(told.moving_flat)));
      }
      widening.widen(pixel, more, tile);
      if (told.unknown[pixel] != 0) tile.set(pixel, sampling::Reason::unseen_light);
    }
}

}  // namespace ifov::render
