#include "io/document/cameras/flight_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/error.h"
#include "core/overloaded.h"
#include "geodesy/geodetic.h"
#include "io/document/cameras/framed_places.h"
#include "io/document/cameras/orbit_path.h"
#include "io/document/cameras/path_table.h"
#include "io/document/platform_document.h"
#include "math/angle.h"
#include "platform/stance.h"
#include "platform/trajectory.h"

namespace ifov::io {
namespace {

using geodesy::Body;
using geodesy::Ecef;
using geodesy::EcefPoint;
using geodesy::Enu;
using geodesy::FrameTransform;
using platform::PathPoint;
using platform::Quaternion;
using platform::Trajectory;

constexpr double kStandardGravity_m_s2 = 9.80665;

/// An attitude with all that a document may leave out.
struct Attitude : PlatformAttitude {
  explicit Attitude(const PlatformDocument& platform)
      : PlatformAttitude(platform.attitude.value_or(PlatformAttitude{})) {
    const bool stands = std::holds_alternative<FixedPath>(platform.path);
    from = PlatformAttitude::from.value_or(stands ? YawFrom::north : YawFrom::track);
  }
  YawFrom from;
};

platform::HeldAttitude held(const Attitude& attitude) {
  return {attitude.angles, attitude.from == YawFrom::track};
}

/// Of a platform that turns by itself; none where it holds angles.
std::optional<platform::Pointing> pointing(const Attitude& attitude, const OriginDocument& origin,
                                           const SceneFrame& scene) {
  if (attitude.look_at)
    return platform::Pointing{scene_point(*attitude.look_at, origin, scene), attitude.angles,
                              attitude.from == YawFrom::track};
  if (attitude.axes == PlatformAxes::velocity) return platform::Pointing{std::nullopt, attitude.angles};
  return std::nullopt;
}

/// How a body stands at a place (ECEF, m) with a velocity over the ground.
platform::Stance stance_about_earth(const Attitude& attitude, EcefPoint place, math::Vec3 velocity_m_s,
                                    const FrameTransform<Enu, Ecef>& scene_from_ecef) {
  const auto ecef_from_level = geodesy::ecef_from_enu(geodesy::geodetic_from_ecef(place));
  math::Vec3 ahead = velocity_m_s;
  if (attitude.from == YawFrom::orbit)
    ahead = ahead + geodesy::kEarthRotation_rad_s * math::Vec3{-place.p.y, place.p.x, 0.0};
  if (attitude.from == YawFrom::north) ahead = ecef_from_level.y().v;
  const bool to_centre = attitude.axes == PlatformAxes::geocentric;
  const auto told = [&](math::Vec3 v) { return scene_from_ecef(geodesy::EcefVector{v}).v; };
  const math::Vec3 down = told(to_centre ? math::Point3{} - place.p : -ecef_from_level.z().v);
  return platform::turned(attitude.axes == PlatformAxes::velocity ? platform::nose_along(told(ahead), down)
                                                                  : platform::belly_along(down, told(ahead)),
                          attitude.angles);
}

/// Level axes at each point of a path about the Earth, the angles of its attitude in them, told in the scene; or other axes.
std::vector<Quaternion> attitudes_about_earth(std::span<const EcefPoint> places,
                                              std::span<const double> times_s, const Attitude& attitude,
                                              const FrameTransform<Enu, Ecef>& scene_from_ecef) {
  const bool level =
      attitude.axes.value_or(PlatformAxes::nadir) == PlatformAxes::nadir && attitude.from != YawFrom::orbit;
  std::vector<double> values;
  for (const EcefPoint& place : places) values.insert(values.end(), {place.p.x, place.p.y, place.p.z});
  const platform::CubicSpline path({times_s.begin(), times_s.end()}, std::move(values));
  std::vector<Quaternion> attitudes;
  for (std::size_t k = 0; k < places.size(); ++k) {
    double at[3] = {}, velocity[3] = {};
    path.at(times_s[k], at, velocity);
    if (!level) {
      attitudes.push_back(platform::quaternion_of(
          stance_about_earth(attitude, places[k], {velocity[0], velocity[1], velocity[2]}, scene_from_ecef)));
      if (!std::isfinite(attitudes.back().w))
        throw InputError(format(
            "at {:g} s the platform flies straight up or down, or stands still: its nose has no direction",
            times_s[k]));
      continue;
    }
    const auto ecef_from_level = geodesy::ecef_from_enu(geodesy::geodetic_from_ecef(places[k]));
    const math::Vec3 flown =
        ecef_from_level.inverse()(geodesy::EcefVector{{velocity[0], velocity[1], velocity[2]}}).v;
    geodesy::Attitude angles = attitude.angles;
    if (attitude.from == YawFrom::track) {
      if (!(std::hypot(flown.x, flown.y) > 0.0))
        throw InputError(
            format("yaw is counted from the track, and at {:g} s the platform does not fly horizontally",
                   times_s[k]));
      angles.yaw_rad += std::atan2(flown.x, flown.y);
    }
    attitudes.push_back(
        platform::quaternion_of(scene_from_ecef * ecef_from_level * geodesy::enu_from_body(angles)));
  }
  return attitudes;
}

class Flight {
 public:
  Flight(const PlatformFlight& flight, const SceneFrame& scene, double from_s, double to_s)
      : flight_(flight), attitude_(flight.platform), scene_(scene), from_s_(from_s), to_s_(to_s) {}

  Trajectory operator()(const StraightPath& path) const {
    const auto [x, y, z] = path.velocity_m_s;
    if (is_about_earth(path.at.frame)) return straight_about_earth(path);
    const math::Point3 start_m = scene_point(path.at, flight_.origin, scene_);
    if (const auto turning = pointing(attitude_, flight_.origin, scene_))
      return Trajectory::straight_pointing(start_m, {x, y, z}, *turning);
    return Trajectory::straight(start_m, {x, y, z}, held(attitude_));
  }

  Trajectory operator()(const FixedPath& path) const {
    const math::Point3 at_m = scene_point(path.at, flight_.origin, scene_);
    if (const auto turning = pointing(attitude_, flight_.origin, scene_))
      return Trajectory::straight_pointing(at_m, {}, *turning);
    if (!is_about_earth(path.at.frame)) return Trajectory::straight(at_m, {}, held(attitude_));
    // Level where it stands.
    const auto ecef_from_scene = io::ecef_from_scene(flight_.origin);
    const platform::Stance stance = stance_about_earth(attitude_, ecef_from_scene(geodesy::EnuPoint{at_m}),
                                                       {}, ecef_from_scene.inverse());
    return Trajectory::fixed(at_m, platform::quaternion_of(stance));
  }

  Trajectory operator()(const CirclingPath& path) const {
    const double right = path.clockwise ? 1.0 : -1.0;
    const double rate_rad_s =
        path.period_s ? 2.0 * std::numbers::pi / *path.period_s : *path.speed_m_s / path.radius_m;
    const platform::Circle circle{scene_point(path.center, flight_.origin, scene_), path.radius_m,
                                  path.start_rad, right * rate_rad_s};
    Attitude attitude = attitude_;
    if (path.banked)
      attitude.angles.roll_rad +=
          right * std::atan(rate_rad_s * rate_rad_s * path.radius_m / kStandardGravity_m_s2);
    if (const auto turning = pointing(attitude, flight_.origin, scene_))
      return Trajectory::circling(circle, *turning);
    return Trajectory::circling(circle, held(attitude));
  }

  Trajectory operator()(const WayPointPath& path) const {
    std::vector<double> times_s;
    for (const WayPoint& point : path.points) times_s.push_back(point.time_s);
    if (is_about_earth(path.frame)) {
      std::vector<EcefPoint> places;
      for (const WayPoint& point : path.points) places.push_back(ecef_point(path.frame, point.place));
      return about_earth(times_s, places, nullptr, path.frame);
    }
    std::vector<math::Point3> places;
    for (const WayPoint& point : path.points)
      places.push_back({point.place[0], point.place[1], point.place[2]});
    return turning_or_held(in_scene(path.frame, path.crs, times_s, places));
  }

  Trajectory operator()(const TablePath& path) const {
    const PathRows table = read_path_table(path.file.path, path.frame);
    if (table.attitude != PathRows::Attitude::none && flight_.platform.attitude)
      throw InputError(
          format("'{}' tells attitudes, and 'attitude' does too; expected one of both", path.file.path));
    return is_about_earth(path.frame) ? about_earth(table, path) : in_scene(table, path);
  }

  Trajectory operator()(const OrbitPath& path) const {
    const OrbitPoints orbit = orbit_points(path, *flight_.time, from_s_, to_s_);
    return about_earth(orbit.times_s, orbit.places, nullptr, PathFrame::ecef);
  }

 private:
  /// Straight in space: of an aircraft that keeps its height the Earth curves away by 8 m in 10 km.
  Trajectory straight_about_earth(const StraightPath& path) const {
    constexpr double kStep_s = 10.0, kMore_s = 1.0, kMost = 100000.0;
    const EcefPoint start = ecef_point(path.at.frame, path.at.place);
    math::Vec3 velocity{path.velocity_m_s[0], path.velocity_m_s[1], path.velocity_m_s[2]};
    if (path.at.frame == PathFrame::geodetic)
      velocity = geodesy::ecef_from_enu(geodesy::geodetic_from_ecef(start))(geodesy::EnuVector{velocity}).v;
    const double first_s = from_s_ - kMore_s, last_s = to_s_ + kMore_s;
    const auto steps = static_cast<int>(std::clamp(std::ceil((last_s - first_s) / kStep_s), 4.0, kMost));
    std::vector<double> times_s;
    std::vector<EcefPoint> places;
    for (int k = 0; k <= steps; ++k) {
      times_s.push_back(first_s + (last_s - first_s) * k / steps);
      places.push_back(start + geodesy::EcefVector{velocity * times_s.back()});
    }
    return about_earth(times_s, places, nullptr, path.at.frame);
  }

  /// Of the scene, or of a map.
  std::vector<PathPoint> in_scene(PathFrame frame, const DocumentName& crs, std::span<const double> times_s,
                                  std::span<math::Point3> places) const {
    if (frame == PathFrame::map) take_from_map(crs, places, scene_);
    std::vector<PathPoint> points;
    for (std::size_t k = 0; k < places.size(); ++k)
      points.push_back({times_s[k], frame == PathFrame::map ? places[k] : places[k] - scene_.offset_m});
    return points;
  }

  Trajectory turning_or_held(std::span<const PathPoint> points) const {
    if (const auto turning = pointing(attitude_, flight_.origin, scene_)) return {points, *turning};
    return {points, held(attitude_)};
  }

  Trajectory in_scene(const PathRows& table, const TablePath& path) const {
    std::vector<double> times_s;
    std::vector<math::Point3> places;
    std::vector<Quaternion> attitudes;
    for (const PathRow& row : table.rows) {
      times_s.push_back(row.time_s);
      places.push_back({row.place[0], row.place[1], row.place[2]});
      attitudes.push_back(table.attitude == PathRows::Attitude::angles
                              ? platform::quaternion_of(geodesy::enu_from_body(row.angles))
                              : row.rotation);
    }
    const std::vector<PathPoint> points = in_scene(path.frame, path.crs, times_s, places);
    if (table.attitude == PathRows::Attitude::none) return turning_or_held(points);
    return {points, attitudes};
  }

  Trajectory about_earth(const PathRows& table, const TablePath& path) const {
    std::vector<double> times_s;
    std::vector<EcefPoint> places;
    for (const PathRow& row : table.rows) {
      times_s.push_back(row.time_s);
      const auto [x, y, z] = row.place;
      places.push_back(is_among_stars(path.frame)
                           ? from_stars(path.frame, path.turn, row.time_s)(geodesy::PointIn<Stars>{{x, y, z}})
                           : ecef_point(path.frame, row.place));
    }
    return about_earth(times_s, places, &table, path.frame, path.turn);
  }

  FrameTransform<Ecef, Stars> from_stars(PathFrame frame, const EarthTurnDocument& turn,
                                         double time_s) const {
    constexpr double kDay_s = 86400.0;
    return ecef_from_stars(frame, {flight_.time->jd1, flight_.time->jd2 + time_s / kDay_s}, turn);
  }

  Trajectory about_earth(std::span<const double> times_s, std::span<const EcefPoint> places,
                         const PathRows* table, PathFrame frame, const EarthTurnDocument& turn = {}) const {
    const auto scene_from_ecef = ecef_from_scene(flight_.origin).inverse();
    std::vector<PathPoint> points;
    for (std::size_t k = 0; k < places.size(); ++k)
      points.push_back({times_s[k], scene_from_ecef(places[k]).p});
    if (table == nullptr || table->attitude == PathRows::Attitude::none) {
      if (attitude_.look_at) return turning_or_held(points);
      return {points, attitudes_about_earth(places, times_s, attitude_, scene_from_ecef)};
    }
    std::vector<Quaternion> attitudes;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const PathRow& row = table->rows[k];
      const auto ecef_from_level = geodesy::ecef_from_enu(geodesy::geodetic_from_ecef(places[k]));
      if (table->attitude == PathRows::Attitude::angles) {
        attitudes.push_back(
            platform::quaternion_of(scene_from_ecef * ecef_from_level * geodesy::enu_from_body(row.angles)));
        continue;
      }
      // The body's axes in the table's frame, by columns: of ECEF, among the stars, or of the level axes of a geodetic place.
      const auto turned = platform::rotation_of(row.rotation);
      const FrameTransform<Ecef, Body> of_ecef({turned.x().v}, {turned.y().v}, {turned.z().v});
      const FrameTransform<Stars, Body> of_stars({turned.x().v}, {turned.y().v}, {turned.z().v});
      attitudes.push_back(platform::quaternion_of(
          scene_from_ecef * (is_among_stars(frame)      ? from_stars(frame, turn, row.time_s) * of_stars
                             : frame == PathFrame::ecef ? of_ecef
                                                        : ecef_from_level * turned)));
    }
    return {points, attitudes};
  }

  const PlatformFlight& flight_;
  const Attitude attitude_;
  const SceneFrame& scene_;
  double from_s_, to_s_;
};

}  // namespace

std::optional<PathFrame> frame_of(const PlatformDocument& platform) {
  using Frame = std::optional<PathFrame>;
  return std::visit(Overloaded{[](const StraightPath& path) -> Frame { return path.at.frame; },
                               [](const FixedPath& path) -> Frame { return path.at.frame; },
                               [](const CirclingPath& path) -> Frame { return path.center.frame; },
                               [](const WayPointPath& path) -> Frame { return path.frame; },
                               [](const TablePath& path) -> Frame { return path.frame; },
                               [](const OrbitPath&) -> Frame { return std::nullopt; }},
                    platform.path);
}

bool flies_about_earth(const PlatformDocument& platform) {
  const std::optional<PathFrame> frame = frame_of(platform);
  return !frame || is_about_earth(*frame);
}

Trajectory trajectory_of(const PlatformFlight& flight, const SceneFrame& scene, double from_s, double to_s) {
  return std::visit(Flight(flight, scene, from_s, to_s), flight.platform.path);
}

std::string path_description(const PlatformFlight& flight, math::Vec3 shift_m, std::string_view axes) {
  const double latitude_rad = flight.origin.geographic ? flight.origin.geographic->latitude_rad : 0.0;
  const auto at = [&](math::Point3 p) {
    p = p + shift_m;
    return format("{} {:.8g}, {:.8g}, {:.6g} m", axes, p.x, p.y, p.z);
  };
  const auto framed = [&](const FramedPoint& point) {
    const auto [x, y, z] = point.place;
    switch (point.frame) {
      case PathFrame::geodetic:
        return format("longitude {:.6f}, latitude {:.6f} deg, height {:.6g} m", x / math::kDegree,
                      y / math::kDegree, z);
      case PathFrame::map: return format("easting {:.8g}, northing {:.8g}, height {:.6g} m", x, y, z);
      case PathFrame::ecef: return format("ECEF {:.9g}, {:.9g}, {:.9g} m", x, y, z);
      default: return at({x, y, z});
    }
  };
  return std::visit(
      Overloaded{[&](const StraightPath& path) {
                   const auto [x, y, z] = path.velocity_m_s;
                   return format("straight from {} at {:.6g} m/s", framed(path.at),
                                 std::sqrt(x * x + y * y + z * z));
                 },
                 [&](const FixedPath& path) { return format("fixed at {}", framed(path.at)); },
                 [&](const CirclingPath& path) {
                   return format("circling {} at {:.6g} m from {}, {:.6g} m/s",
                                 path.clockwise ? "clockwise" : "counterclockwise", path.radius_m,
                                 framed(path.center),
                                 path.speed_m_s.value_or(2.0 * std::numbers::pi * path.radius_m /
                                                         path.period_s.value_or(1.0)));
                 },
                 [&](const WayPointPath& path) {
                   return format("through {} points from {}", path.points.size(),
                                 framed({path.frame, path.points.front().place}));
                 },
                 [&](const TablePath& path) {
                   return format("along '{}'{}", path.file.path,
                                 is_among_stars(path.frame) ? turn_remark(path.turn, latitude_rad) : "");
                 },
                 [&](const OrbitPath& path) {
                   const auto* file = std::get_if<DocumentFile>(&path.source);
                   return format("on the orbit {}{}",
                                 file != nullptr
                                     ? format("of '{}'", file->path)
                                     : format("from its state at {}",
                                              geodesy::format_utc(std::get<OrbitState>(path.source).epoch)),
                                 turn_remark(path.turn, latitude_rad));
                 }},
      flight.platform.path);
}

namespace {

/// What a free orbit leaves out: measured with and without (docs/theory/orbits.md).
std::vector<std::string> state_remarks(double age_d) {
  constexpr double kMost_h = 1.0, kOff_km_h = 0.35, kAir_km_h2 = 0.035;
  const double age_h = 24.0 * std::abs(age_d);
  if (age_h <= kMost_h) return {};
  return {format(
      "the state of the orbit is {:.3g} hours {} than the image: what it leaves out moves low satellites by some {:.2g} km until "
      "then (gravity by longitude, Sun and Moon), and by {:.2g} km more at 400 km (air); expected at most {:g} hour",
      age_h, age_d > 0.0 ? "older" : "younger", kOff_km_h * age_h, kAir_km_h2 * age_h * age_h, kMost_h)};
}

}  // namespace

std::vector<std::string> flight_remarks(const PlatformFlight& flight) {
  const auto* orbit = std::get_if<OrbitPath>(&flight.platform.path);
  if (orbit == nullptr || !flight.time) return {};
  const double age_d = orbit_age_days(*orbit, *flight.time);
  if (std::holds_alternative<OrbitState>(orbit->source)) return state_remarks(age_d);
  constexpr double kOld_d = 30.0;
  if (std::abs(age_d) <= kOld_d) return {};
  // What two-line elements are commonly said to be worth: a kilometre at the epoch, 1 to 3 km a day from there.
  return {format(
      "the elements of '{}' are {:.0f} days {} than the image: SGP4 leaves them by some 1 to 3 km a day, here {:.0f} to {:.0f} km; "
      "expected at most {:g} days",
      std::get<DocumentFile>(orbit->source).path, std::abs(age_d), age_d > 0.0 ? "older" : "younger",
      std::abs(age_d), 3.0 * std::abs(age_d), kOld_d)};
}

}  // namespace ifov::io
