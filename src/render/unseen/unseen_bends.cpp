#include "render/unseen/unseen_bends.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world.h"
#include "materials/bsdf/narrow_lobes.h"
#include "render/mirrors/sought_instants.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/unseen/widen_unseen.h"
#include "sampling/hash.h"
#include "sampling/random.h"
#include "sampling/tile.h"
#include "sampling/warp.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/delta_events.h"
#include "transport/emitters.h"
#include "transport/mirrors/emitter_mirrors.h"
#include "transport/mirrors/sun_mirrors.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

using math::Point3;
using math::Vec3;

namespace {

/// Rays of the lattice along a side of a pixel, and of each towards what throws light.
constexpr int kAcross = 2;
constexpr std::uint64_t kSent = 32;
/// Mirrors and boundaries that are followed, one behind another.
constexpr int kMostMet = 8;
/// What shines is made so wide that it fills this: all directions within 15 deg of its middle.
constexpr double kWideCosine = 0.966, kWide_sr = 2.0 * std::numbers::pi * (1.0 - kWideCosine);
/// Of more, neighbours are put together.
constexpr std::size_t kMostTargets = 128;
constexpr std::uint64_t kBendChoice = 0x62656e6473ull;

}  // namespace

/// Mirrors and boundaries that a ray meets: at each it takes one side by chance.
class UnseenBends::Chain {
 public:
  Chain(const transport::SpectralScene& scene, bool in_medium) : scene_(scene), in_medium_(in_medium) {}

  double weight = 1.0;  ///< what goes on, at most, over the probability of the way
  geometry::SurfacePoint hit;
  scene::ResolvedSurface surface;  ///< where the ray met something that scatters
  bool scatters = false;
  bool in_medium() const { return in_medium_; }
  /// Whether light of what shines is sought by way of what was met so far.
  bool is_sought() const { return bends_ == 0 && (reflections_ == 0 || (reflections_ == 1 && known_)); }

  /// Calls at(ray) with each ray that leaves a mirror or a boundary, outside of media.
  template <class At>
  void follow(math::Ray& ray, std::uint64_t key, sampling::RayCounts& counts, const At& at) {
    for (std::uint64_t met = 0; met <= kMostMet; ++met) {
      scene_.scene().world->intersect({&ray, 1}, {&hit, 1});
      ++counts.shadow;
      if (!hit.hit()) return;
      const auto random = [&](std::uint64_t which) {
        return sampling::unit_double(sampling::hash(key, 2 * met + which, kBendChoice));
      };
      surface = scene_.scene().resolve(hit);
      transport::SurfaceLobe lobe = transport::surface_lobe(scene_, surface, random(0));
      if (lobe.bsdf == nullptr) return;
      if (!lobe.bsdf->is_delta()) {
        scatters = true;
        return;
      }
      turn(ray, lobe, random(1));
      if (!(weight > 0.0)) return;
      if (!in_medium_) at(ray);
    }
  }

 private:
  void turn(math::Ray& ray, transport::SurfaceLobe& lobe, double choice) {
    materials::BsdfEvent view = transport::delta_view(-ray.direction, hit, surface);
    if (lobe.directional) transport::narrow_to_angle(scene_, surface, view, lobe);
    const double all = lobe.highest_reflectance + lobe.highest_transmittance;
    weight *= all;
    if (!(all > 0.0)) return;
    const bool through = choice * all >= lobe.highest_reflectance;
    view.side = through ? materials::Side::transmitted : materials::Side::reflected;
    const materials::BsdfSample sample = lobe.bsdf->sample(view, 0.5, 0.5);
    if (!(sample.weight > 0.0)) {
      weight = 0.0;
      return;
    }
    const Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
    ray = ray.onward(through ? transport::beyond_surface(hit) : hit.position_m + hit.offset_m * outward,
                     sample.incoming);
    const materials::Passage passage = lobe.bsdf->passage();
    if (!through) {
      if (in_medium_) ++bends_;
      const transport::EmitterMirrors* mirrors = scene_.emitter_mirrors();
      known_ = mirrors != nullptr &&
               (mirrors->rounds().sought(hit) || mirrors->plane_of(hit, surface.shading_normal.as_vector()) !=
                                                     transport::EmitterMirrors::kNone);
      ++reflections_;
    } else if (passage == materials::Passage::into || passage == materials::Passage::out_of) {
      ++bends_;
      in_medium_ = passage == materials::Passage::into;
    }
  }

  const transport::SpectralScene& scene_;
  bool in_medium_;
  int bends_ = 0, reflections_ = 0;
  bool known_ = false;
};

/// Directions from a surface towards spheres about what throws light, by their share of the view; over all of a side where it lies in one.
class UnseenBends::Aims {
 public:
  Aims(std::span<const geometry::SurfaceSurvey::Ball> throwers, Point3 at, Vec3 outward, bool both_sides) {
    for (const auto& thrower : throwers) {
      const Vec3 to = thrower.centre_m - at;
      const double apart = length(to), sine = thrower.radius_m / std::max(apart, 1e-300);
      if (sine < 1.0) {
        aims_.push_back({to / apart, sampling::UniformCone(std::asin(sine)), sine * sine});
        continue;
      }
      const sampling::UniformCone half(0.5 * std::numbers::pi);
      aims_.push_back({outward, half, both_sides ? 0.5 : 1.0});
      if (both_sides) aims_.push_back({-outward, half, 0.5});
    }
    double all = 0.0;
    for (const Aim& aim : aims_) all += aim.share;
    for (Aim& aim : aims_) aim.share /= all;
  }
  Vec3 sample(double choice, sampling::Point2 u) const {
    std::size_t picked = 0;
    while (picked + 1 < aims_.size() && choice >= aims_[picked].share) choice -= aims_[picked++].share;
    return aims_[picked].cone.sample(aims_[picked].axis, u);
  }
  /// Of all spheres in which a direction lies, 1/sr.
  double density(Vec3 direction) const {
    double sum = 0.0;
    for (const Aim& aim : aims_) sum += aim.share * aim.cone.density(aim.axis, direction);
    return sum;
  }

 private:
  struct Aim {
    Vec3 axis;
    sampling::UniformCone cone;
    double share;
  };
  std::vector<Aim> aims_;
};

struct UnseenBends::Told {
  Told(std::size_t pixels, std::size_t channel_count)
      : channels(channel_count),
        thrown(pixels * channels, 0.0),
        first_moment(pixels, 0.0),
        second_moment(pixels, 0.0) {}
  std::size_t channels;
  std::vector<double> thrown;  ///< by pixel and channel: that light
  /// By pixel: mean and mean square of what a scattered path of it finds of that light, over the usual radiance.
  std::vector<double> first_moment, second_moment;
};

std::unique_ptr<const UnseenBends> UnseenBends::find(const transport::SpectralScene& scene,
                                                     const sensor::Camera& camera, std::uint64_t seed) {
  const bool moving = scene.scene().world->moving() != nullptr;
  if (scene.emitters() == nullptr || !(scene.emitters()->outshine() || moving) ||
      !(scene.materials().any_medium() || transport::EmitterMirrors::leave_some(scene.scene())))
    return nullptr;
  std::unique_ptr<const UnseenBends> unseen(new UnseenBends(scene, camera, seed));
  if (unseen->throwers_.empty() || (unseen->targets_.empty() && !unseen->moving_.any())) return nullptr;
  return unseen;
}

UnseenBends::UnseenBends(const transport::SpectralScene& scene, const sensor::Camera& camera,
                         std::uint64_t seed)
    : scene_(scene),
      camera_(camera),
      seed_(sampling::hash(seed, kBendChoice)),
      parts_(scene),
      moving_(scene.scene(), camera, parts_),
      targets_(put_together(still_targets(scene.scene(), parts_), kMostTargets)) {
  const geometry::SurfaceSurvey* const survey = scene.scene().world->survey();
  if (survey == nullptr) return;
  std::vector<geometry::SurfaceSurvey::Ball> balls = survey->balls;
  for (const auto& round : survey->rounds) balls.push_back(round.ball);
  for (const auto& smooth : survey->smooths) balls.push_back(smooth.ball);
  for (const auto& flat : survey->flats) {
    const Vec3 across = flat.bounds.high_m - flat.bounds.low_m;
    balls.push_back({flat.bounds.low_m + 0.5 * across, 0.5 * length(across)});
  }
  for (const auto& group : transport::SunMirrors::grouped(std::move(balls)))
    for (const Vec3 moved : copies_about(scene.scene()))
      throwers_.push_back({at_home(scene.scene(), group.centre_m) + moved, group.radius_m});
}

bool UnseenBends::is_free(const math::Ray& from, const ShiningTarget& target,
                          sampling::RayCounts& counts) const {
  const Vec3 to = target.centre_m - at_home(scene_.scene(), from.origin_m);
  const double distance = length(to), before = distance - target.reach_m();
  if (!(before > 0.0)) return true;
  const math::Ray ray{from.origin_m, to / distance, 0.0, before * (1.0 - 1e-6),
                      target.moving != nullptr ? target.moving->time_s : from.time_s};
  geometry::SurfacePoint hit;
  scene_.scene().world->intersect({&ray, 1}, {&hit, 1});
  ++counts.shadow;
  if (!hit.hit()) return true;
  // What bends light may lie between there and what shines itself: other things alone hide it.
  const scene::ResolvedSurface surface = scene_.scene().resolve(hit);
  return std::any_of(surface.begin(), surface.end(), [&](const scene::Constituent& part) {
    return scene_.materials().maximum_transmittance(part.material) > 0.0f;
  });
}

void UnseenBends::add_exit(const math::Ray& exit, double weight, std::size_t pixel, ShiningTargets& targets,
                           Told& told, sampling::RayCounts& counts) const {
  const Point3 at = at_home(scene_.scene(), exit.origin_m);
  for (const ShiningTarget& target : targets.at(exit.time_s)) {
    const Vec3 to = target.centre_m - at;
    const double distance = length(to), radius = target.part.ball.radius_m;
    const double sine = distance > radius ? radius / distance : 1.0;
    const double light_sr = std::numbers::pi * sine * sine * target.part.fill;
    if (!(dot(to, exit.direction) > std::min(kWideCosine, std::sqrt(1.0 - sine * sine)) * distance)) continue;
    const double share = weight * target.of_time() * std::min(1.0, light_sr / kWide_sr);
    if (!(share > 0.0) || !is_free(exit, target, counts)) continue;
    const std::span<const double> radiance = parts_.highest(target.part.assignment);
    for (std::size_t c = 0; c < told.channels; ++c)
      told.thrown[pixel * told.channels + c] += share * radiance[c];
  }
}

void UnseenBends::send(const math::Ray& seen, std::uint64_t name, std::size_t pixel, ShiningTargets& targets,
                       Told& told, sampling::RayCounts& counts) const {
  Chain view(scene_, false);
  math::Ray ray = seen;
  view.follow(ray, sampling::hash(seed_, name, kSent), counts, [](const math::Ray&) {});
  if (!view.scatters) return;
  double spread = 0.0;
  bool passes = false;
  for (const scene::Constituent& part : view.surface) {
    const materials::Bsdf& bsdf = *scene_.scene().materials[part.material].bsdf;
    if (!bsdf.is_delta()) spread += part.weight * scene_.brightest(part.material);
    passes = passes || scene_.materials().maximum_transmittance(part.material) > 0.0f;
  }
  if (!(spread > 0.0)) return;
  const Vec3 outward = (view.hit.front ? view.hit.geometric_normal : -view.hit.geometric_normal).as_vector();
  const Point3 at = at_home(scene_.scene(), view.hit.position_m);
  const Aims aims(throwers_, at, outward, passes);
  for (std::uint64_t k = 0; k < kSent; ++k) {
    const std::uint64_t key = sampling::hash(seed_, name, k);
    const auto random = [&](std::uint64_t which) {
      return sampling::unit_double(sampling::hash(key, which));
    };
    const Vec3 direction = aims.sample(random(0), {random(1), random(2)});
    const double side = dot(direction, outward);
    if (!(side > 0.0) && !passes) continue;
    const double density = aims.density(direction);
    if (!(density > 0.0)) continue;  // rounding, at a rim
    const double of_path = view.weight * spread;
    const double weight = of_path * std::abs(side) / (std::numbers::pi * density * kSent * kAcross * kAcross);
    math::Ray sent =
        ray.onward(view.hit.position_m + (side > 0.0 ? 1.0 : -1.0) * view.hit.offset_m * outward, direction);
    Chain way(scene_, view.in_medium());
    way.follow(sent, key, counts, [&](const math::Ray& exit) {
      if (!way.is_sought()) add_exit(exit, weight * way.weight, pixel, targets, told, counts);
    });
    if (!way.hit.hit() || way.is_sought() || way.in_medium()) continue;
    if (const std::uint32_t part = parts_.part_of(way.hit); part != transport::ShiningParts::kNone) {
      const double found = way.weight * parts_.parts()[part].contrast;
      told.first_moment[pixel] += weight * found;
      told.second_moment[pixel] += weight * of_path * found * found;
    }
  }
}

void UnseenBends::settle(const AccuracyTolerance* tolerance, sampling::TileResult& tile) const {
  if (tolerance == nullptr || !tile.has_errors()) return;
  const int width = tile.tile.width(), height = tile.tile.height();
  const std::vector<double> times_s = lattice_times_s(camera_);
  std::vector<sampling::FocalPoint> points;
  std::vector<std::uint64_t> names;  // the same in every division into tiles
  for (int y = tile.tile.y0; y < tile.tile.y1; ++y)
    for (int x = tile.tile.x0; x < tile.tile.x1; ++x)
      for (std::uint64_t k = 0; k < kAcross * kAcross; ++k) {
        names.push_back(sampling::hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), k));
        points.push_back({x + (static_cast<double>(k % kAcross) +
                               sampling::unit_double(sampling::hash(seed_, names.back(), 1))) /
                                  kAcross,
                          y + (static_cast<double>(k / kAcross) +
                               sampling::unit_double(sampling::hash(seed_, names.back(), 2))) /
                                  kAcross,
                          times_s[names.back() % times_s.size()]});
      }
  std::vector<math::Ray> rays(points.size());
  camera_.rays(points, rays);
  tile.rays.primary += rays.size();
  Told told(static_cast<std::size_t>(tile.tile.count()), scene_.nodes().channel_count());
  ShiningTargets targets(moving_, targets_);
  for (std::size_t k = 0; k < rays.size(); ++k)
    send(rays[k], names[k], k / (kAcross * kAcross), targets, told, tile.rays);

  std::vector<double> more(told.channels);
  UnseenWidening widening(*tolerance, told.channels, kNegligible);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto pixel = static_cast<std::size_t>(y * width + x);
      const auto around = [&](std::span<const double> what, std::size_t per_pixel, std::size_t c) {
        return mean_about(what, per_pixel, c, x, y, width, height);
      };
      const double paths = std::max(1.0, static_cast<double>(tile.radiance_evaluations[pixel]));
      const double first = around(told.first_moment, 1, 0), second = around(told.second_moment, 1, 0);
      // As many paths as if each of them found all or nothing of it.
      if (second > 0.0 && paths * first * first > kKnown * second) continue;
      for (std::size_t c = 0; c < told.channels; ++c)
        more[c] = kCaution *
                  std::max(told.thrown[pixel * told.channels + c], around(told.thrown, told.channels, c));
      widening.widen(pixel, more, tile);
    }
}

}  // namespace ifov::render
