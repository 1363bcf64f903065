#include "io/document/cameras/flight_path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/overloaded.h"
#include "geodesy/geodetic.h"
#include "geodesy/line_of_sight.h"
#include "io/document/cameras/orbit_path.h"
#include "io/document/cameras/path_table.h"
#include "io/document/platform_document.h"
#include "math/angle.h"
#include "platform/trajectory.h"
#include "sensor/camera.h"

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

geodesy::Geodetic place_of(const OriginDocument& origin) {
  return {origin.geographic->latitude_rad, origin.geographic->longitude_rad, origin.height_m};
}

platform::HeldAttitude held(const std::optional<PlatformAttitude>& attitude) {
  const PlatformAttitude angles = attitude.value_or(PlatformAttitude{});
  return {angles.angles, angles.from_track};
}

/// Level axes at each point of a path about the Earth, the angles of its attitude in them, told in the scene.
std::vector<Quaternion> attitudes_about_earth(std::span<const EcefPoint> places,
                                              std::span<const double> times_s,
                                              const platform::HeldAttitude& attitude,
                                              const FrameTransform<Enu, Ecef>& scene_from_ecef) {
  std::vector<double> values;
  for (const EcefPoint& place : places) values.insert(values.end(), {place.p.x, place.p.y, place.p.z});
  const platform::CubicSpline path({times_s.begin(), times_s.end()}, std::move(values));
  std::vector<Quaternion> attitudes;
  for (std::size_t k = 0; k < places.size(); ++k) {
    double at[3] = {}, velocity[3] = {};
    path.at(times_s[k], at, velocity);
    const auto ecef_from_level = geodesy::ecef_from_enu(geodesy::geodetic_from_ecef(places[k]));
    const math::Vec3 flown =
        ecef_from_level.inverse()(geodesy::EcefVector{{velocity[0], velocity[1], velocity[2]}}).v;
    geodesy::Attitude angles = attitude.angles;
    if (attitude.from_track) {
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
  Flight(const PlatformFlight& flight, math::Vec3 offset_m, double from_s, double to_s)
      : flight_(flight), offset_m_(offset_m), from_s_(from_s), to_s_(to_s) {}

  Trajectory operator()(const StraightPath& path) const {
    const auto [x, y, z] = path.velocity_m_s;
    return Trajectory::straight(path.position_m - offset_m_, {x, y, z}, held(flight_.platform.attitude));
  }

  Trajectory operator()(const WayPointPath& path) const {
    std::vector<PathPoint> points;
    for (const WayPoint& point : path.points) points.push_back({point.time_s, point.position_m - offset_m_});
    return {points, held(flight_.platform.attitude)};
  }

  Trajectory operator()(const TablePath& path) const {
    const PathRows table = read_path_table(path.file.path, path.frame);
    if (table.attitude != PathRows::Attitude::none && flight_.platform.attitude)
      throw InputError(
          format("'{}' tells attitudes, and 'attitude' does too; expected one of both", path.file.path));
    return path.frame == PathFrame::scene ? in_scene(table) : about_earth(table, path.frame);
  }

  Trajectory operator()(const OrbitPath& path) const {
    const OrbitPoints orbit = orbit_points(path, *flight_.time, from_s_, to_s_);
    return about_earth(orbit.times_s, orbit.places, nullptr, PathFrame::ecef);
  }

 private:
  Trajectory in_scene(const PathRows& table) const {
    std::vector<PathPoint> points;
    std::vector<Quaternion> attitudes;
    for (const PathRow& row : table.rows) {
      points.push_back({row.time_s, math::Point3{row.place[0], row.place[1], row.place[2]} - offset_m_});
      attitudes.push_back(table.attitude == PathRows::Attitude::angles
                              ? platform::quaternion_of(geodesy::enu_from_body(row.angles))
                              : row.rotation);
    }
    if (table.attitude == PathRows::Attitude::none) return {points, held(flight_.platform.attitude)};
    return {points, attitudes};
  }

  Trajectory about_earth(const PathRows& table, PathFrame frame) const {
    std::vector<double> times_s;
    std::vector<EcefPoint> places;
    for (const PathRow& row : table.rows) {
      times_s.push_back(row.time_s);
      places.push_back(frame == PathFrame::geodetic
                           ? geodesy::ecef_from_geodetic({row.place[1], row.place[0], row.place[2]})
                           : EcefPoint{{row.place[0], row.place[1], row.place[2]}});
    }
    return about_earth(times_s, places, &table, frame);
  }

  Trajectory about_earth(std::span<const double> times_s, std::span<const EcefPoint> places,
                         const PathRows* table, PathFrame frame) const {
    const auto scene_from_ecef = geodesy::ecef_from_enu(place_of(flight_.origin)).inverse();
    std::vector<PathPoint> points;
    for (std::size_t k = 0; k < places.size(); ++k)
      points.push_back({times_s[k], scene_from_ecef(places[k]).p});
    if (table == nullptr || table->attitude == PathRows::Attitude::none)
      return {points,
              attitudes_about_earth(places, times_s, held(flight_.platform.attitude), scene_from_ecef)};
    std::vector<Quaternion> attitudes;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const PathRow& row = table->rows[k];
      const auto ecef_from_level = geodesy::ecef_from_enu(geodesy::geodetic_from_ecef(places[k]));
      if (table->attitude == PathRows::Attitude::angles) {
        attitudes.push_back(
            platform::quaternion_of(scene_from_ecef * ecef_from_level * geodesy::enu_from_body(row.angles)));
        continue;
      }
      // The body's axes in the table's frame, by columns: of ECEF, or of the level axes of a geodetic place.
      const auto turned = platform::rotation_of(row.rotation);
      const FrameTransform<Ecef, Body> of_ecef({turned.x().v}, {turned.y().v}, {turned.z().v});
      attitudes.push_back(platform::quaternion_of(
          scene_from_ecef * (frame == PathFrame::ecef ? of_ecef : ecef_from_level * turned)));
    }
    return {points, attitudes};
  }

  const PlatformFlight& flight_;
  math::Vec3 offset_m_;
  double from_s_, to_s_;
};

std::string degrees_of(const geodesy::Geodetic& place) {
  return format("latitude {:.4f}, longitude {:.4f} deg", place.latitude_rad / math::kDegree,
                place.longitude_rad / math::kDegree);
}

}  // namespace

bool flies_about_earth(const PlatformDocument& platform) {
  if (const auto* table = std::get_if<TablePath>(&platform.path)) return table->frame != PathFrame::scene;
  return std::holds_alternative<OrbitPath>(platform.path);
}

void check_flight(const PlatformFlight& flight) {
  if (!flies_about_earth(flight.platform)) return;
  if (!flight.origin.geographic)
    throw InputError(
        "a path about the Earth needs the place of the scene: expected an 'origin' of the scene with 'latitude' and "
        "'longitude'");
  if (std::holds_alternative<OrbitPath>(flight.platform.path) && !flight.time)
    throw InputError("an orbit needs the document's 'time'");
}

Trajectory trajectory_of(const PlatformFlight& flight, math::Vec3 offset_m, double from_s, double to_s) {
  return std::visit(Flight(flight, offset_m, from_s, to_s), flight.platform.path);
}

void check_flatness(const sensor::Camera& camera, const OriginDocument& origin) {
  constexpr double kEarth_m = 6371008.8, kMost_m = 1.0;
  const auto ecef_from_scene = geodesy::ecef_from_enu(place_of(origin));
  const math::Ray middle = camera.middle_ray();
  const double elevation = std::atan2(middle.origin_m.z, std::hypot(middle.origin_m.x, middle.origin_m.y));
  if (!(elevation > 0.0))
    throw InputError(format(
        "the platform is {:.1f} degrees below the scene's horizon, over {}", -elevation / math::kDegree,
        degrees_of(geodesy::geodetic_from_ecef(ecef_from_scene(geodesy::EnuPoint{middle.origin_m})))));
  // Where a ray meets the Earth, and how far from the scene's origin that is.
  struct Seen {
    std::optional<geodesy::Geodetic> place;
    double away_m = 0.0;
  };
  const auto seen = [&](const math::Ray& ray) -> Seen {
    const auto at = geodesy::on_ellipsoid(ecef_from_scene(geodesy::EnuPoint{ray.origin_m}),
                                          ecef_from_scene(geodesy::EnuVector{ray.direction}));
    if (!at) return {};
    return {geodesy::geodetic_from_ecef(*at), length(*at - ecef_from_scene.origin())};
  };
  const double widest_m = std::sqrt(2.0 * kEarth_m * kMost_m);
  const Seen at_middle = seen(middle);
  if (!at_middle.place)
    throw InputError("the camera looks past the Earth: the middle of its image meets no ground");
  if (at_middle.away_m > widest_m)
    throw InputError(format(
        "the camera looks past the scene: the middle of its image lies at {}, {:.4g} km from the scene's origin",
        degrees_of(*at_middle.place), 1e-3 * at_middle.away_m));
  for (const double y : {0.0, camera.middle_line_px(), 1.0 * camera.height_px()})
    for (const double x : {0.0, 1.0 * camera.width_px()}) {
      const Seen corner = seen(camera.ray({x, y}));
      if (!corner.place)
        throw InputError("the camera looks past the Earth: the rim of its image meets no ground");
      if (corner.away_m <= widest_m) continue;
      throw InputError(format(
          "the image reaches {:.4g} km from the scene's origin (to {}), where the Earth's surface lies {:.3g} m below the flat scene; "
          "expected at most {:g} m, which is {:.3g} km: look at less, or move the origin",
          1e-3 * corner.away_m, degrees_of(*corner.place), corner.away_m * corner.away_m / (2.0 * kEarth_m),
          kMost_m, 1e-3 * widest_m));
    }
}

std::string path_description(const PlatformDocument& platform, math::Vec3 shift_m, std::string_view axes) {
  const auto at = [&](math::Point3 p) {
    p = p + shift_m;
    return format("{} {:.8g}, {:.8g}, {:.6g} m", axes, p.x, p.y, p.z);
  };
  return std::visit(
      Overloaded{[&](const StraightPath& path) {
                   const auto [x, y, z] = path.velocity_m_s;
                   return format("straight from {} at {:.6g} m/s", at(path.position_m),
                                 std::sqrt(x * x + y * y + z * z));
                 },
                 [&](const WayPointPath& path) {
                   return format("through {} points from {}", path.points.size(),
                                 at(path.points.front().position_m));
                 },
                 [](const TablePath& path) { return format("along '{}'", path.file.path); },
                 [](const OrbitPath& path) { return format("on the orbit of '{}'", path.file.path); }},
      platform.path);
}

std::vector<std::string> flight_remarks(const PlatformFlight& flight) {
  const auto* orbit = std::get_if<OrbitPath>(&flight.platform.path);
  if (orbit == nullptr || !flight.time) return {};
  constexpr double kOld_d = 30.0;
  const double age_d = orbit_age_days(*orbit, *flight.time);
  if (std::abs(age_d) <= kOld_d) return {};
  // What two-line elements are commonly said to be worth: a kilometre at the epoch, 1 to 3 km a day from there.
  return {format(
      "the elements of '{}' are {:.0f} days {} than the image: SGP4 leaves them by some 1 to 3 km a day, here {:.0f} to {:.0f} km; "
      "expected at most {:g} days",
      orbit->file.path, std::abs(age_d), age_d > 0.0 ? "older" : "younger", std::abs(age_d),
      3.0 * std::abs(age_d), kOld_d)};
}

}  // namespace ifov::io
