#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/overloaded.h"
#include "geodesy/geodetic.h"
#include "geodesy/line_of_sight.h"
#include "io/document/cameras/flight_path.h"
#include "io/document/cameras/frame_check.h"
#include "io/document/cameras/framed_places.h"
#include "io/document/platform_document.h"
#include "math/angle.h"
#include "sensor/camera.h"

namespace ifov::io {
namespace {

std::string degrees_of(const geodesy::Geodetic& place) {
  return format("latitude {:.4f}, longitude {:.4f} deg", place.latitude_rad / math::kDegree,
                place.longitude_rad / math::kDegree);
}

DocumentName crs_of(const PlatformDocument& platform) {
  return std::visit(Overloaded{[](const StraightPath& path) { return path.at.crs; },
                               [](const FixedPath& path) { return path.at.crs; },
                               [](const CirclingPath& path) { return path.center.crs; },
                               [](const WayPointPath& path) { return path.crs; },
                               [](const TablePath& path) { return path.crs; },
                               [](const OrbitPath&) { return DocumentName{}; }},
                    platform.path);
}

}  // namespace

void check_frame(const FramedPoint& point, const char* what, const OriginDocument& origin) {
  if (is_about_earth(point.frame) && !origin.geographic)
    throw InputError(
        format("{} needs the place of the scene: expected an 'origin' of the scene with 'latitude' and "
               "'longitude'",
               what));
  if (point.frame != PathFrame::map) return;
  if (point.crs.name.empty() && origin.crs.empty())
    throw InputError(
        "the frame is \"map\", and nothing says which: expected a 'crs' beside it, such as \"EPSG:25832\", or one of the scene's "
        "'origin'");
  if (origin.crs.empty() && !origin.geographic)
    throw InputError(
        "a place on a map needs that of the scene: expected an 'origin' of the scene with 'latitude' and 'longitude', or with a 'crs'");
}

void check_flight(const PlatformFlight& flight) {
  const bool stands = std::holds_alternative<FixedPath>(flight.platform.path);
  const auto* circling = std::get_if<CirclingPath>(&flight.platform.path);
  const bool about_earth = flies_about_earth(flight.platform);
  if (const auto& attitude = flight.platform.attitude) {
    if (stands && (attitude->from.value_or(YawFrom::north) != YawFrom::north ||
                   attitude->axes == PlatformAxes::velocity))
      throw InputError(
          "what is fixed flies nowhere, so that its nose cannot be along its track or velocity: expected 'from' \"north\", and other "
          "'axes'");
    if (circling != nullptr && circling->banked && attitude->look_at)
      throw InputError(
          "'bank' is of wings, and 'look_at' turns the belly to a point: expected one of both (a 'mount' with a 'gimbal' looks at a point "
          "from banked wings)");
    if (circling != nullptr && circling->banked && attitude->from == YawFrom::north)
      throw InputError("'bank' is about a nose along the track, and 'from' says north; expected one of both");
    if (circling != nullptr && attitude->axes == PlatformAxes::geocentric)
      throw InputError(
          "a circle is level in the scene, whose ground is flat: expected 'axes' \"nadir\" or \"velocity\"");
    if (attitude->axes == PlatformAxes::geocentric && !about_earth)
      throw InputError(
          "'axes' that are \"geocentric\" need a path about the Earth: in the scene's frame the ground is flat, expected \"nadir\"");
    if (attitude->from == YawFrom::orbit && (!about_earth || circling != nullptr || attitude->look_at))
      throw InputError(format("'from' \"orbit\" {}, expected \"track\" or \"north\"",
                              about_earth && circling == nullptr ? "is of axes that turn to no point"
                                                                 : "needs a path about the Earth"));
    if (attitude->from == YawFrom::north && attitude->axes == PlatformAxes::velocity)
      throw InputError(
          "'axes' along the velocity have their nose there, and 'from' says north; expected one of both");
  }
  if (const std::optional<FramedPoint> at = flight.platform.attitude.value_or(PlatformAttitude{}).look_at)
    check_frame(*at, "a point about the Earth", flight.origin);
  const std::optional<PathFrame> frame = frame_of(flight.platform);
  check_frame({frame.value_or(PathFrame::teme), {}, crs_of(flight.platform)}, "a path about the Earth",
              flight.origin);
  if (!frame && !flight.time) throw InputError("an orbit needs the document's 'time'");
  if (frame && is_among_stars(*frame) && !flight.time)
    throw InputError("under a path among the stars the Earth turns: expected the document's 'time'");
}

void check_flatness(const sensor::Camera& camera, const PlatformFlight& flight) {
  if (!flies_about_earth(flight.platform)) return;
  constexpr double kEarth_m = 6371008.8, kMost_m = 1.0;
  const auto ecef_from_scene = io::ecef_from_scene(flight.origin);
  const math::Ray middle = camera.middle_ray();
  const double away_m = std::hypot(middle.origin_m.x, middle.origin_m.y),
               elevation = std::atan2(middle.origin_m.z, away_m);
  const double widest_m = std::sqrt(2.0 * kEarth_m * kMost_m);
  // What stands or circles near the scene's origin looks where it likes, to the horizon too, as in the scene's own frame.
  const bool stays = std::holds_alternative<FixedPath>(flight.platform.path) ||
                     std::holds_alternative<CirclingPath>(flight.platform.path);
  if (!(elevation > 0.0) && !(stays && away_m < widest_m))
    throw InputError(format(
        "the platform is {:.1f} degrees below the scene's horizon, over {}", -elevation / math::kDegree,
        degrees_of(geodesy::geodetic_from_ecef(ecef_from_scene(geodesy::EnuPoint{middle.origin_m})))));
  if (stays) return;
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

}  // namespace ifov::io
