#include "render/unseen/unseen_images.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world.h"
#include "render/mirrors/mirror_images.h"
#include "sampling/random.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/emitters.h"
#include "transport/mirrors/emitter_mirrors.h"
#include "transport/mirrors/mirror_paths.h"
#include "transport/mirrors/sun_mirrors.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

using math::Vec3;
using transport::SeparateImages;

namespace {

/// What directions between three may lie beyond them, over their spread (GlintSearch's).
constexpr double kBeyond = 1.2;
/// Of the usual radiance: what counts for nothing.
constexpr double kTooLittle = 1e-4;
/// Spread of directions that say nothing of what lies between them.
constexpr double kAnywhere = 2.0;

/// Whether one plane of mirrors stands in the scene, or none.
bool one_plane(const geometry::SurfaceSurvey& survey) {
  return survey.rounds.empty() && survey.smooths.empty() && survey.balls.empty() &&
         survey.flats.size() == 1 && survey.flats[0].planes_m.size() == 1;
}

}  // namespace

std::unique_ptr<const UnseenImages> UnseenImages::find(const transport::SpectralScene& scene,
                                                       const sensor::Camera& camera,
                                                       const MirrorImages& images, std::uint64_t seed) {
  const geometry::World& world = *scene.scene().world;
  const std::vector<scene::SurfaceAssignment>& assignments = scene.scene().assignments;
  const bool reliefs = std::any_of(assignments.begin(), assignments.end(),
                                   [](const scene::SurfaceAssignment& c) { return c.bends_normals(); });
  std::unique_ptr<const UnseenImages> unseen(new UnseenImages(scene, camera, images, seed));
  if (unseen->moving_.any()) return unseen;
  if (one_plane(*world.survey()) && !world.period() && !reliefs && images.all_settled()) return nullptr;
  if (unseen->targets_.empty() && images.parts().complete()) return nullptr;
  return unseen;
}

UnseenImages::UnseenImages(const transport::SpectralScene& scene, const sensor::Camera& camera,
                           const MirrorImages& images, std::uint64_t seed)
    : scene_(scene),
      camera_(camera),
      images_(images),
      channels_(scene.nodes().channel_count()),
      complete_(images.parts().complete()),
      moving_(scene.scene(), camera, images.parts()),
      shift_x_(sampling::unit_double(sampling::hash(seed, 0x756e7365656eull)) / kAcross),
      shift_y_(sampling::unit_double(sampling::hash(seed, 0x756e7365656full)) / kAcross) {
  list_throwers();
  const auto period = scene.scene().world->period();
  for (const transport::ShiningParts::Part& part : images.parts().parts()) {
    if (!period) {
      targets_.push_back({part, part.ball.centre_m});
      continue;
    }
    // The copies about a ray that is moved to the first cell.
    const math::Point3 c = part.ball.centre_m;
    const Vec3 home{-std::floor(c.x / period->x_m) * period->x_m,
                    -std::floor(c.y / period->y_m) * period->y_m, 0.0};
    for (int column = -1; column <= 1; ++column)
      for (int row = -1; row <= 1; ++row)
        targets_.push_back({part, c + home + Vec3{column * period->x_m, row * period->y_m, 0.0}});
  }
}

void UnseenImages::list_throwers() {
  const geometry::SurfaceSurvey& survey = *scene_.scene().world->survey();
  const transport::EmitterMirrors* mirrors = scene_.emitter_mirrors();
  const transport::Emitters* emitters = scene_.emitters();
  for (const geometry::SurfaceSurvey::Round& round : survey.rounds) {
    Thrower thrower{&round, {}};
    const bool sought = mirrors != nullptr && mirrors->rounds().seeks_all_of(round.object);
    thrower.all_sought.assign(scene_.scene().assignments.size(), false);
    for (std::uint32_t c = 0; c < thrower.all_sought.size(); ++c)
      thrower.all_sought[c] = sought && emitters->seeks_all_of(c);
    throwers_.push_back(std::move(thrower));
  }
}

std::vector<std::vector<UnseenImages::Leaving>> UnseenImages::follow(
    const std::vector<sampling::FocalPoint>& points, std::vector<Lit>& lit,
    sampling::RayCounts& counts) const {
  const scene::Scene& scene = scene_.scene();
  std::vector<std::vector<Leaving>> levels;
  std::vector<math::Ray> rays(points.size());
  camera_.rays(points, rays);
  counts.primary += rays.size();
  std::vector<std::size_t> who(points.size());
  for (std::size_t k = 0; k < who.size(); ++k) who[k] = k;
  std::vector<geometry::SurfacePoint> hits;
  for (std::size_t level = 0; level < kMostMirrors && !rays.empty(); ++level) {
    hits.resize(rays.size());
    scene.world->intersect(rays, hits);
    if (level > 0) counts.continuation += rays.size();
    std::vector<Leaving> leaving(points.size());
    std::size_t kept = 0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const geometry::SurfacePoint& hit = hits[k];
      if (!hit.hit()) continue;
      const scene::ResolvedSurface surface = scene.resolve(hit);
      double share = 0.0, scattered = 0.0;
      for (const scene::Constituent& part : surface)
        (transport::is_mirror(scene, part) ? share : scattered) +=
            part.weight * scene_.brightest(part.material);
      if (level == 0 && scattered > 0.0)
        lit.push_back({hit.position_m, rays[k].time_s,
                       (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector(), who[k],
                       scattered});
      if (!(share > 0.0)) continue;
      const Vec3 normal = surface.shading_normal.as_vector(), seen = rays[k].direction;
      Leaving& next = leaving[who[k]];
      next.direction = math::normalized(seen - 2.0 * dot(seen, normal) * normal);
      next.outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
      if (!(dot(next.direction, next.outward) > 0.0)) continue;
      const Leaving* before = level > 0 ? &levels[level - 1][who[k]] : nullptr;
      next.any = true;
      next.at = hit.position_m + hit.offset_m * next.outward;
      next.time_s = rays[k].time_s;
      // Faces of one object count as one where they bend, each as its own else.
      const std::uint64_t face =
          hit.bend == geometry::Bend::none || hit.bend == geometry::Bend::facet ? hit.primitive + 1u : 0u;
      next.way = sampling::hash(before != nullptr ? before->way : level, hit.instance, hit.patch, face);
      if (before == nullptr) next.only = images_.apart().mirror_of(hit, normal);
      next.brightness = (before != nullptr ? before->brightness : 1.0) * share;
      rays[kept] = rays[k].onward(next.at, next.direction);
      who[kept++] = who[k];
    }
    rays.resize(kept);
    who.resize(kept);
    if (kept > 0) levels.push_back(std::move(leaving));
  }
  return levels;
}

bool UnseenImages::is_free(math::Point3 from, double time_s, math::Point3 centre_m, double radius_m,
                           sampling::RayCounts& counts) const {
  const Vec3 to = centre_m - from;
  const double distance = length(to), before = distance - radius_m;
  if (!(before > 0.0)) return true;
  const math::Ray ray{from, to / distance, 0.0, before * (1.0 - 1e-6), time_s};
  std::uint8_t blocked = 0;
  scene_.scene().world->occluded({&ray, 1}, {&blocked, 1});
  ++counts.shadow;
  return blocked == 0;
}

/// A wave of radius D that a sphere of radius R reflects at an angle t spreads over (a + 2 L / (R cos t)) (a + 2 L cos t / R),
/// a = 1 + L / D, at a distance L: at least (a + 2 L / R)^2, as cos t + 1 / cos t >= 2. Of a cylinder one factor is a.
void UnseenImages::add_thrown(const Lit& lit, double weight, ShiningTargets& moving, double* unseen,
                              sampling::RayCounts& counts) const {
  for (const Thrower& thrower : throwers_) {
    const geometry::SurfaceSurvey::Round& round = *thrower.round;
    const Vec3 x = round.scene_from_unit.column_x(), y = round.scene_from_unit.column_y(),
               z = round.scene_from_unit.column_z();
    const bool tube =
        round.kind == geometry::UnitKind::cylinder || round.kind == geometry::UnitKind::open_cylinder;
    // The least curved place of an ellipsoid.
    const double longest = std::max({length(x), length(y), tube ? 0.0 : length(z)}),
                 shortest = std::min({length(x), length(y), tube ? longest : length(z)});
    const double radius = longest * longest / shortest;
    const double apart = length(round.ball.centre_m - lit.at), way = apart - round.ball.radius_m;
    const double cosine = (dot(round.ball.centre_m - lit.at, lit.outward) + round.ball.radius_m) /
                          std::max(apart, round.ball.radius_m);
    if (!(cosine > 0.0)) continue;
    const double nearest = std::max(way, 0.0);
    bool free = false, asked = false;
    const auto add = [&](const ShiningTarget& target) {
      if (target.moving == nullptr && thrower.all_sought[target.part.assignment]) return true;
      const double to =
          std::max(length(target.centre_m - round.ball.centre_m) - round.ball.radius_m - target.way_m(),
                   target.part.ball.radius_m);
      const double a = 1.0 + nearest / to, other = a + 2.0 * nearest / radius;
      const double arrives_sr = std::numbers::pi * std::pow(target.part.ball.radius_m / to, 2) *
                                target.part.fill / (other * (tube ? a : other));
      const double share =
          target.of_time() * weight * lit.brightness * std::min(1.0, cosine) * arrives_sr / std::numbers::pi;
      if (!(share * target.part.contrast > kTooLittle)) return true;
      if (!asked)
        free = is_free(lit.at + 1e-6 * (1.0 + apart) * lit.outward, lit.time_s, round.ball.centre_m,
                       round.ball.radius_m, counts);
      asked = true;
      if (!free) return false;
      const std::span<const double> highest = images_.parts().highest(target.part.assignment);
      for (std::size_t c = 0; c < highest.size(); ++c) unseen[c] += share * highest[c];
      return true;
    };
    if (!std::all_of(targets_.begin(), targets_.end(), add)) continue;
    const std::span<const ShiningTarget> others = moving.at(lit.time_s);
    static_cast<void>(std::all_of(others.begin(), others.end(), add));
  }
}

void UnseenImages::search(const Leaving* const (&corner)[3], double area_px2, ShiningTargets& moving,
                          double* unseen, sampling::RayCounts& counts) const {
  search(corner, area_px2, targets_, unseen, counts);
  if (!moving_.any()) return;
  for (const Leaving* const at : corner)
    if (at->any) return search(corner, area_px2, moving.at(at->time_s), unseen, counts);
}

void UnseenImages::search(const Leaving* const (&corner)[3], double area_px2,
                          std::span<const ShiningTarget> targets, double* unseen,
                          sampling::RayCounts& counts) const {
  const bool alike = corner[0]->any && corner[1]->any && corner[2]->any && corner[0]->way == corner[1]->way &&
                     corner[0]->way == corner[2]->way;
  const auto period = scene_.scene().world->period();
  for (const ShiningTarget& target : targets) {
    const double reach_m = target.part.ball.radius_m + target.way_m();
    const auto meets = [&](const Leaving& from, Vec3& off, double& wide) {
      math::Point3 at = from.at;
      if (period)
        at = at - Vec3{std::floor(at.x / period->x_m) * period->x_m,
                       std::floor(at.y / period->y_m) * period->y_m, 0.0};
      const Vec3 to = target.centre_m - at;
      const double distance = length(to);
      wide = distance > reach_m ? std::asin(reach_m / distance) : std::numbers::pi;
      off = from.direction - to / std::max(distance, 1e-300);
      return dot(to, from.outward) > -reach_m;
    };
    const auto add = [&](const Leaving& from, double spread, double wide, double area) {
      if (target.moving == nullptr && from.only != SeparateImages::kNone &&
          images_.settled(from.only, target.part.object))
        return;
      // Of what moves, as it is at one instant: it is met as seldom as it is there.
      const double filled =
          std::pow(std::sin(std::min(wide, 0.5 * std::numbers::pi)) * target.part.ball.radius_m / reach_m,
                   2) *
          target.part.fill * target.of_time();
      // pi of both cancels; an equilateral triangle has 0.43 of its squared side.
      if (area_px2 * std::numbers::pi * filled > kMet_px2 * 0.43 * spread * spread) return;
      const double share = std::min(1.0, filled / std::pow(std::min(kAnywhere, kBeyond * spread + wide), 2));
      const double time_s = target.moving != nullptr ? target.moving->time_s : from.time_s;
      if (!(share > 0.0) || (!period && !is_free(from.at, time_s, target.centre_m, reach_m, counts))) return;
      const std::span<const double> highest = images_.parts().highest(target.part.assignment);
      for (std::size_t c = 0; c < highest.size(); ++c)
        unseen[c] += area * share * from.brightness * highest[c];
    };
    if (!alike) {
      // Each as those go on that came the same way beside it.
      for (const Leaving* from : corner) {
        Vec3 off, other;
        double wide = 0.0, spread = kAnywhere, unused = 0.0;
        if (!from->any || !meets(*from, off, wide)) continue;
        if (from->beside[0] != nullptr && from->beside[1] != nullptr) {
          spread = 0.0;
          for (const Leaving* beside : from->beside) {
            meets(*beside, other, unused);
            spread += length(off - other);
          }
        }
        if (spread >= kAnywhere || length(off) <= (1.0 + kBeyond) * spread + wide)
          add(*from, spread, wide, area_px2 / 3.0);
      }
      continue;
    }
    Vec3 off[3];
    double wide[3];
    bool any = false;
    for (int k = 0; k < 3; ++k) any = meets(*corner[k], off[k], wide[k]) || any;
    const double spread =
        std::max({length(off[0] - off[1]), length(off[1] - off[2]), length(off[2] - off[0])});
    const double widest = std::max({wide[0], wide[1], wide[2]});
    if (!any || length((off[0] + off[1] + off[2]) / 3.0) > kBeyond * spread + widest) continue;
    add(*corner[0], spread, widest, area_px2);
  }
}

}  // namespace ifov::render
