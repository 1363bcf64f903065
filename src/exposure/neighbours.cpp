#include "exposure/neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "exposure/exposed_point.h"
#include "geometry/surface_point.h"
#include "geometry/world.h"
#include "sampling/random.h"
#include "sampling/warp.h"
#include "thermal/faces/sky_longwave.h"

namespace ifov::exposure {
namespace {

constexpr int kTimes = 8;  // that may have warmed a neighbour, of which one is asked for
constexpr double kUpright = 1e-6;
constexpr double kNear_m = 20.0;  // about as high is the ground so far away, for the wind of what is met

enum class Of { past, row, now, warmed, times, around, further, further_past, goes_on, corner, both };

double number(std::uint64_t key, Of of, int k = 0) {
  return sampling::unit_double(sampling::hash(key, of, k));
}

}  // namespace

Neighbours::Neighbours(scene::Scene scene, ByNumber classes, double sun_radius_rad)
    : scene_(std::move(scene)),
      past_(*scene_.world, scene_.departed.get()),
      classes_(std::move(classes)),
      sun_radius_rad_(sun_radius_rad) {
  for (const auto& one : classes_)
    if (any_ == nullptr) any_ = one.get();
}

bool Neighbours::sees_sun(const ExposedPoint& point, std::size_t row, std::uint64_t key) const {
  const std::int32_t sunlit = any_->sunlit_row_of(row);
  if (sunlit < 0) return false;
  const double steps = number(key, Of::row, 0) + number(key, Of::row, 1) - 1.0;
  const math::Vec3 middle = any_->sun_at(static_cast<std::size_t>(sunlit), steps);
  const math::Vec3 direction = sampling::UniformCone(sun_radius_rad_)
                                   .sample(middle, {number(key, Of::row, 2), number(key, Of::row, 3)});
  const double time_s = any_->time_s(row, steps);
  std::uint8_t is_free = 0;
  point.free({&direction, 1}, past_.changes() ? std::span(&time_s, 1) : std::span<const double>(),
             {&is_free, 1});
  return is_free != 0;
}

bool Neighbours::sees_sky(const ExposedPoint& point, std::uint64_t key) const {
  static thread_local std::vector<math::Vec3> directions;
  point.sky_directions(key, 1, directions);
  std::uint8_t is_free = 0;
  if (!directions.empty()) point.free({directions.data(), 1}, {}, {&is_free, 1});
  return is_free != 0;
}

std::size_t Neighbours::warming_row(const thermal::Pose& pose, const thermal::SurfaceClasses& classes,
                                    const thermal::SurfaceClasses::Corners& at, std::size_t row,
                                    std::uint64_t key) const {
  std::array<std::size_t, kTimes> rows;
  std::array<double, kTimes> until_w_m2;
  double sum_w_m2 = 0.0;
  const auto gain_w_m2 = [&](std::size_t of) {
    const std::int32_t sunlit = classes.sunlit_row_of(of);
    if (sunlit < 0) return 0.0;
    return classes.outdoors(of).direct_w_m2 *
           classes.facing(pose.normal, classes.sun_at(static_cast<std::size_t>(sunlit), 0.0));
  };
  for (int k = 0; k < kTimes; ++k) {
    const std::size_t lag =
        classes.draw_lag(at, number(key, Of::times, 2 * k), (k + number(key, Of::times, 2 * k + 1)) / kTimes);
    rows[static_cast<std::size_t>(k)] = row - std::min(row, lag);
    until_w_m2[static_cast<std::size_t>(k)] = sum_w_m2 += gain_w_m2(row - std::min(row, lag));
  }
  std::size_t warmed = row;
  if (sum_w_m2 > 0.0) {
    const double place = sum_w_m2 * number(key, Of::warmed);
    warmed = rows[static_cast<std::size_t>(std::upper_bound(until_w_m2.begin(), until_w_m2.end() - 1, place) -
                                           until_w_m2.begin())];
  } else {
    while (warmed > 0 && !(gain_w_m2(warmed) > 0.0)) --warmed;  // the last evening
  }
  return warmed;
}

thermal::Pose Neighbours::pose_of(const ExposedPoint& point, const geometry::SurfacePoint& met,
                                  double ground_m) const {
  if (std::isnan(ground_m) || met.distance_m > kNear_m) return point.pose();
  return {point.normal(), std::max(0.0, met.position_m.z - ground_m)};
}

thermal::FromBeside Neighbours::sent(const geometry::SurfacePoint& met, std::size_t row, Behind behind,
                                     std::uint64_t key) const {
  const scene::Constituent main = scene_.resolve_without_temperature(met).constituents[0];
  const scene::SurfaceState& state = scene_.states[main.state];
  const thermal::SurfaceClasses* const own = state.solved > 0 ? classes_[state.solved - 1].get() : nullptr;
  const thermal::SurfaceClasses& classes = own != nullptr ? *own : *any_;
  const thermal::Outdoors& now = classes.outdoors(row);
  const thermal::FromBeside ground = classes.from_ground(row);
  const bool two_faces = own != nullptr && own->two_faces();
  const ExposedPoint point(past_, met, two_faces);
  const thermal::Pose pose = pose_of(point, met, behind.ground_m);
  // What is sent leaves by the side that was met; light that comes to the other one goes through a leaf.
  const math::Vec3 side = two_faces ? ExposedPoint(past_, met).normal() : pose.normal;
  const double through = two_faces ? own->skin().transmittance : 0.0;
  const double back = own != nullptr ? 1.0 - own->skin().solar_absorptance - through : 0.0;

  double light_w_m2 = 0.0, behind_w_m2 = 0.0;
  std::optional<bool> lit;
  if (const std::int32_t sunlit = classes.sunlit_row_of(row); sunlit >= 0) {
    const double cosine = math::dot(side, classes.sun_at(static_cast<std::size_t>(sunlit), 0.0));
    if (cosine > 0.0 || two_faces) lit = sees_sun(point, row, sampling::hash(key, Of::now));
    if (lit.value_or(false)) (cosine > 0.0 ? light_w_m2 : behind_w_m2) += now.direct_w_m2 * std::abs(cosine);
  }
  // One direction tells what is about it: sky, a further surface, or the ground.
  const bool from_behind = through > 0.0 && number(key, Of::around, 2) * (back + through) < through;
  const math::Vec3 around =
      sampling::TangentFrame(from_behind ? -side : side)
          .to_world(sampling::cosine_hemisphere({number(key, Of::around, 0), number(key, Of::around, 1)}));
  geometry::SurfacePoint beyond;
  if (point.leaves(around)) {
    const math::Ray ray = point.ray(around);
    scene_.world->intersect({&ray, 1}, {&beyond, 1});
  }
  const bool is_sky = around.z > 0.0 && !beyond.hit(), goes_on = beyond.hit() && behind.depth > 0;
  const auto is_asked = [&](int which) {
    return goes_on && (behind.chance >= 1.0 || number(key, Of::goes_on, which) < behind.chance);
  };
  const Behind next{behind.depth - 1, behind.chance, behind.ground_m};
  thermal::FromBeside comes = ground;
  if (is_sky) comes = {now.diffuse_w_m2, now.longwave_w_m2};
  if (is_asked(0)) {
    const thermal::FromBeside more = sent(beyond, row, next, sampling::hash(key, Of::further));
    comes.sunlight_w_m2 += (more.sunlight_w_m2 - ground.sunlight_w_m2) / behind.chance;
    comes.longwave_w_m2 += (more.longwave_w_m2 - ground.longwave_w_m2) / behind.chance;
  }
  if (from_behind)
    behind_w_m2 += comes.sunlight_w_m2 * (back + through) / through;
  else
    light_w_m2 += through > 0.0 ? comes.sunlight_w_m2 * (back + through) / back : comes.sunlight_w_m2;
  if (own == nullptr) {
    double given_k = main.mapped_temperature_k > 0.0 ? main.mapped_temperature_k : state.temperature_k;
    if (!(given_k > 0.0)) given_k = now.air.temperature_k;
    return {classes.ground_reflectance() * light_w_m2,
            thermal::kStefanBoltzmann_w_m2_k4 * std::pow(given_k, 4)};
  }
  const double open = own->open_share(pose.normal);
  const thermal::SurfaceClasses::Corners at = own->any_corner(pose, number(key, Of::corner));
  double free_sky = is_sky && open > kUpright ? 1.0 / open : 0.0;
  if (two_faces) free_sky = sees_sky(point, sampling::hash(key, Of::both)) ? 1.0 : 0.0;
  const auto then = own->then(at, free_sky, own->bin_of_row(row));
  double surface_k = then.shaded_k;
  if (then.rise_k != 0.0) {
    const std::uint64_t warmed_key = sampling::hash(key, Of::warmed);
    const std::size_t warmed = warming_row(pose, *own, at, row, warmed_key);
    if (warmed == row && lit ? *lit : sees_sun(point, warmed, sampling::hash(warmed_key, Of::warmed, 1)))
      surface_k += then.rise_k;
  }
  double fourth_power = std::pow(surface_k, 4);
  double of_warming = 1.0;
  if (two_faces) {  // either face is warmed by what it sees
    of_warming = 2.0;
    const math::Vec3 from =
        sampling::TangentFrame(number(key, Of::both, 0) < 0.5 ? side : -side)
            .to_world(sampling::cosine_hemisphere({number(key, Of::both, 1), number(key, Of::both, 2)}));
    beyond = this->met(point, from);
  }
  const bool goes_further = two_faces
                                ? beyond.hit() && behind.depth > 0 &&
                                      (behind.chance >= 1.0 || number(key, Of::goes_on, 1) < behind.chance)
                                : is_asked(1);
  if (goes_further) {
    const std::size_t lag =
        own->draw_lag(at, number(key, Of::further_past, 0), number(key, Of::further_past, 1));
    const std::size_t then_row = row - std::min(row, lag);
    const double warmer_k =
        surface_k + of_warming * own->worth_of_all_k(at) *
                        own->more_than_ground_w_m2(
                            sent(beyond, then_row, next, sampling::hash(key, Of::further_past, 2)), then_row);
    fourth_power += (std::pow(warmer_k, 4) - fourth_power) / behind.chance;
  }
  const thermal::Skin& skin = own->skin();
  return {back * light_w_m2 + through * behind_w_m2,
          skin.emissivity * thermal::kStefanBoltzmann_w_m2_k4 * fourth_power +
              (1.0 - skin.emissivity) * comes.longwave_w_m2};
}

Neighbours::Change Neighbours::change(const ExposedPoint& point, const thermal::SurfaceClasses& classes,
                                      const thermal::SurfaceClasses::Corners& at, math::Vec3 direction,
                                      const geometry::SurfacePoint& met, std::uint64_t key,
                                      Behind behind) const {
  const thermal::SurfaceClasses::PastRow past =
      classes.draw_past(at, {number(key, Of::past, 0), number(key, Of::past, 1), number(key, Of::past, 2)});
  if (past_.changes()) {
    const double time_s = classes.time_s(past.row, 0.0);
    std::uint8_t was_free = 0;
    point.free({&direction, 1}, {&time_s, 1}, {&was_free, 1});
    if (was_free != 0) return {};
  }
  const double more_w_m2 =
      classes.more_than_ground_w_m2(sent(met, past.row, behind, sampling::hash(key, Of::further)), past.row);
  return {past.in_shade_k * more_w_m2, past.of_sun_k * more_w_m2};
}

geometry::SurfacePoint Neighbours::met(const ExposedPoint& point, math::Vec3 direction) const {
  geometry::SurfacePoint met;
  if (!point.leaves(direction)) return met;
  const math::Ray ray = point.ray(direction);
  scene_.world->intersect({&ray, 1}, {&met, 1});
  return met;
}

void Neighbours::met(const ExposedPoint& point, std::span<const math::Vec3> directions,
                     std::vector<geometry::SurfacePoint>& met) const {
  static thread_local std::vector<math::Ray> rays;
  static thread_local std::vector<geometry::SurfacePoint> hits;
  rays.clear();
  for (const math::Vec3 direction : directions)
    if (point.leaves(direction)) rays.push_back(point.ray(direction));
  hits.resize(rays.size());
  if (!rays.empty()) scene_.world->intersect(rays, hits);
  met.assign(directions.size(), {});
  for (std::size_t k = 0, ray = 0; k < directions.size(); ++k)
    if (point.leaves(directions[k])) met[k] = hits[ray++];
}

Neighbours::Change Neighbours::change(const ExposedPoint& point, const thermal::SurfaceClasses& classes,
                                      const thermal::SurfaceClasses::Corners& at, math::Vec3 direction,
                                      std::uint64_t key, Behind behind) const {
  const geometry::SurfacePoint found = met(point, direction);
  return found.hit() ? change(point, classes, at, direction, found, key, behind) : Change{};
}

void Neighbours::changes(std::span<const Time> by_time, const thermal::Pose& pose,
                         const geometry::SurfacePoint& met, std::uint64_t key, Behind behind,
                         std::span<Change> changes) {
  static thread_local std::vector<const thermal::SurfaceClasses*> classes;
  static thread_local std::vector<thermal::SurfaceClasses::PastRow> past;
  classes.clear();
  for (const Time& time : by_time) classes.push_back(time.classes);
  past.resize(by_time.size());
  const std::size_t drawn =
      thermal::SurfaceClasses::draw_past(classes, pose,
                                         {number(key, Of::past, 0), number(key, Of::past, 1),
                                          number(key, Of::past, 2), number(key, Of::past, 3)},
                                         past);
  const double more_w_m2 = classes[drawn]->more_than_ground_w_m2(
      by_time[drawn].neighbours->sent(met, past[drawn].row, behind, sampling::hash(key, Of::further)),
      past[drawn].row);
  for (std::size_t t = 0; t < changes.size(); ++t)
    changes[t] = {past[t].in_shade_k * more_w_m2, past[t].of_sun_k * more_w_m2};
}

}  // namespace ifov::exposure
