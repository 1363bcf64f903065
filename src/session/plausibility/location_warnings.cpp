#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "core/names.h"
#include "geodesy/geodetic.h"
#include "geometry/world.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/document.h"
#include "io/document/shapes/box_primitive.h"
#include "math/angle.h"
#include "sensor/camera.h"
#include "session/assembly/shared/map_scale.h"
#include "session/loaded/acquisition_assembly.h"
#include "session/loaded/parts.h"
#include "session/plausibility/location_lines.h"
#include "session/plausibility/plausibility_warnings.h"

namespace ifov::session {
namespace {

constexpr std::size_t kObjectsNamed = 3;

/// The share of directions in which a place sees the back of a surface before anything else.
double backs_about(const geometry::World& world, math::Point3 position) {
  std::vector<math::Ray> rays;
  constexpr int kAround = 12;
  for (const double z : {-0.9, -0.5, 0.0, 0.5, 0.9})
    for (int k = 0; k < kAround; ++k) {
      const double turn = 2.0 * std::numbers::pi * (k + 0.37) / kAround, r = std::sqrt(1.0 - z * z);
      rays.push_back({position, {r * std::cos(turn), r * std::sin(turn), z}});
    }
  std::vector<geometry::SurfacePoint> hits(rays.size());
  world.intersect(rays, hits);
  return static_cast<double>(
             std::count_if(hits.begin(), hits.end(), [](const auto& h) { return h.hit() && !h.front; })) /
         static_cast<double>(hits.size());
}

void warn_of_camera(const Parts& parts, const SceneSurvey& survey, LogSink& log) {
  const geometry::World& world = *parts.scene.world;
  const double top_m = world.heights().high_m;
  for (const std::string& remark : parts.document.sensor.camera.settings->remarks()) log.warn(remark);
  const math::Vec3 offset_m = parts.document.scene.origin.offset_m;
  if (const auto height_m = parts.document.sensor.camera.settings->start_height_m();
      height_m && *height_m - offset_m.z < top_m)
    log.warn(format(
        "the camera's 'height' of {:g} m lies below the top of the scene at {:g} m: what is above it is not seen. "
        "Leave 'height' out, and rays start above everything",
        *height_m, top_m + offset_m.z));
  const std::optional<math::Point3> position = parts.camera->pose(parts.camera->middle_line_px()).position_m;
  if (position && world.object_count() > 0 && parts.camera->view_list() == nullptr) {
    constexpr double kInside = 0.9;
    const math::Ray up{*position, {0.0, 0.0, 1.0}};
    geometry::SurfacePoint above;
    world.intersect({&up, 1}, {&above, 1});
    const double backs = backs_about(world, *position);
    if (backs >= kInside)
      log.warn(
          format("the camera is inside of {}: it sees the backs of surfaces all around. Move its 'position'",
                 above.hit() ? title_of(parts.document.scene.objects, parts.placed.of(above.instance))
                             : "something solid"));
    else if (above.hit() && !above.front && above.geometric_normal.z > 0.0)
      log.warn(format("the camera is under the ground: {} lies {:.4g} m above it. Raise its 'position'",
                      title_of(parts.document.scene.objects, parts.placed.of(above.instance)),
                      above.distance_m));
  }
  if (survey.sky_share < 1.0) return;
  if (position && parts.camera->view_list() != nullptr) return;  // points and rays may well look at the sky
  if (world.object_count() == 0)
    return log.warn("the scene holds no objects: the picture shows nothing but sky");
  const geometry::World::Bounds b = world.bounds();
  log.warn(format(
      "the camera sees nothing of the scene, which lies at {}: all of {} rays meet nothing. Look at its {}",
      area_text(parts, {b.low_m.x, b.high_m.x}, {b.low_m.y, b.high_m.y}), survey.rays,
      position ? "'position' and where it looks" : "'center'"));
}

void warn_of_objects_out_of_view(const Parts& parts, const SceneSurvey& survey, LogSink& log) {
  if (survey.sky_share >= 1.0) return;
  std::size_t whole = 0;
  std::string names;
  for (std::size_t d = 0; d < survey.in_frame.size(); ++d) {
    if (survey.surveyed[d] == 0 || survey.in_frame[d] > 0) continue;
    if (whole++ < kObjectsNamed)
      names += (names.empty() ? "" : ", ") + title_of(parts.document.scene.objects, d);
  }
  // Of a landscape around the picture much is out of view, and that is meant; the line "in view" counts it.
  if (whole == 0 || 2 * whole < survey.in_frame.size()) return;
  if (whole > kObjectsNamed) names += format(" and {} more", whole - kObjectsNamed);
  log.warn(format("{} of {} objects of the document {} wholly out of the picture: {}{}", whole,
                  survey.in_frame.size(), whole == 1 ? "is" : "are", names,
                  parts.document.scene.origin.has_map_offset
                      ? "; with 'easting' and 'northing', positions are map coordinates"
                      : ""));
}

/// Copies so far away that their coordinates must be of another frame.
void warn_of_far_objects(const Parts& parts, const SceneSurvey& survey, LogSink& log) {
  const geometry::World& world = *parts.scene.world;
  if (survey.x_m.low > survey.x_m.high) return;
  const math::Point3 middle{0.5 * (survey.x_m.low + survey.x_m.high),
                            0.5 * (survey.y_m.low + survey.y_m.high), 0.0};
  const double across_m = std::max({survey.x_m.high - survey.x_m.low, survey.y_m.high - survey.y_m.low, 1.0});
  constexpr double kFar_m = 20e3, kFarAcross = 100.0;
  constexpr std::uint32_t kSurveyed = 2000;
  for (std::size_t d = 0; d < parts.placed.document_objects(); ++d) {
    const std::uint32_t count = parts.placed.count(d), step = count / kSurveyed + 1;
    std::uint32_t far = 0, surveyed = 0;
    double furthest_m = 0.0;
    for (std::uint32_t k = 0; k < count; k += step, ++surveyed) {
      const geometry::World::PlacedObject object = world.object(parts.placed.first(d) + k);
      if (!std::isfinite(object.radius_m)) continue;
      const double distance_m =
          std::hypot(object.centre_m.x - middle.x, object.centre_m.y - middle.y) - object.radius_m;
      far += distance_m > std::max(kFar_m, kFarAcross * across_m);
      furthest_m = std::max(furthest_m, distance_m);
    }
    if (far == 0) continue;
    const io::OriginDocument& origin = parts.document.scene.origin;
    log.warn(format(
        "{}: {} lie{} up to {:.0f} km from the picture: are {} coordinates of another frame? {}",
        title_of(parts.document.scene.objects, d),
        count == 1 ? std::string("it")
                   : format("{} of {} copies", static_cast<double>(far) / surveyed * count, count),
        count == 1 ? "s" : "", furthest_m / 1000.0, count == 1 ? "its" : "their",
        origin.has_map_offset || !origin.crs.empty()
            ? "The scene's are map coordinates, since its 'origin' has some"
            : "The scene's are metres about its origin; for map coordinates give the scene's 'origin' an 'easting' "
              "and a 'northing'"));
  }
}

void warn_of_sizes(const Parts& parts, const SceneSurvey& survey, LogSink& log) {
  if (survey.x_m.low > survey.x_m.high) return;
  constexpr double kMuchLarger = 100.0, kMuchSmaller = 0.02, kKilometre_m = 1000.0;
  const double across_m =
      std::max({survey.x_m.high - survey.x_m.low, survey.y_m.high - survey.y_m.low, survey.gsd_m.high});
  for (std::size_t d = 0; d < parts.placed.document_objects(); ++d) {
    const io::ShapeDocument& shape = parts.document.scene.objects[d].shape;
    const bool from_file = std::holds_alternative<io::MeshShape>(shape) ||
                           std::holds_alternative<io::InstanceShape>(shape) ||
                           std::holds_alternative<io::InstancesShape>(shape);
    // Who writes a small ball or disk means a target below a pixel.
    if (parts.placed.count(d) == 0 || (!from_file && !io::is_primitive(shape, io::BoxPrimitive::kModel)))
      continue;
    const double size_m = 2.0 * parts.scene.world->object(parts.placed.first(d)).radius_m;
    if (from_file && size_m > std::max(kMuchLarger * across_m, kKilometre_m))
      log.warn(format(
          "{} is {:.4g} m across, the picture {:.4g} m: are the mesh's coordinates millimetres? Then say "
          "\"unit\": \"mm\"",
          title_of(parts.document.scene.objects, d), size_m, across_m));
    if (size_m < kMuchSmaller * survey.gsd_m.low)
      log.warn(format("{} is {:.3g} m across, less than a fiftieth of a pixel of {:.4g} m: are {} meant?",
                      title_of(parts.document.scene.objects, d), size_m, survey.gsd_m.low,
                      from_file ? "its coordinates of another unit, and is such a pixel"
                                : "such a size and such a pixel"));
  }
}

void warn_of_shared_locations(const Parts& parts, const SceneSurvey& survey, LogSink& log) {
  constexpr double kNoticed = 0.001;
  std::vector<SceneSurvey::Shared> shared = survey.shared;
  std::sort(shared.begin(), shared.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
  std::size_t named = 0;
  for (const SceneSurvey::Shared& one : shared) {
    if (one.share < kNoticed || named++ >= kObjectsNamed) break;
    log.warn(format(
        "surfaces of {} and {} lie in one place in {:.2g} % of the picture: {} is seen there, {}. Lift one by a "
        "centimetre, or put it elsewhere in the list",
        title_of(parts.document.scene.objects, one.seen), title_of(parts.document.scene.objects, one.hidden),
        100.0 * one.share, title_of(parts.document.scene.objects, one.seen),
        one.seen > one.hidden ? "which is the later of the two in the document"
                              : "which is higher by less than a hair"));
  }
}

/// Maps that lie where nothing is: their outermost cells would cover everything.
void warn_of_maps(const Parts& parts, const SceneSurvey& survey, LogSink& log) {
  if (survey.x_m.low > survey.x_m.high) return;
  SceneSurvey::Range x = survey.x_m, y = survey.y_m;
  const geometry::World::Bounds b = parts.scene.world->bounds();
  x = {std::min(x.low, b.low_m.x), std::max(x.high, b.high_m.x)};
  y = {std::min(y.low, b.low_m.y), std::max(y.high, b.high_m.y)};
  for (const MapScale& map : parts.map_scales) {
    const double east_m = map.west_m + map.width_m, south_m = map.north_m - map.height_m;
    if (map.repeats || (map.west_m < x.high && east_m > x.low && south_m < y.high && map.north_m > y.low))
      continue;
    log.warn(format(
        "map '{}' covers {}, and all of the scene lies at {}: everything gets the value of its nearest cell. Are these "
        "coordinates of another frame?",
        map.path, area_text(parts, {map.west_m, east_m}, {south_m, map.north_m}), area_text(parts, x, y)));
  }
}

/// Degrees where metres of a map are expected.
void warn_of_degrees(const Parts& parts, LogSink& log) {
  const io::OriginDocument& origin = parts.document.scene.origin;
  if (!origin.has_map_offset) return;
  if (std::abs(origin.offset_m.x) <= 180.0 && std::abs(origin.offset_m.y) <= 90.0 &&
      (origin.offset_m.x != 0.0 || origin.offset_m.y != 0.0))
    log.warn(format(
        "the origin's easting {:g} m and northing {:g} m look like longitude and latitude: give those as "
        "'longitude' and 'latitude', in deg",
        origin.offset_m.x, origin.offset_m.y));
}

/// Two places for one origin: the Sun follows the first, the map the second.
void warn_of_two_origins(const Parts& parts, LogSink& log) {
  constexpr double kNoticed_m = 5000.0;
  const io::OriginDocument& origin = parts.document.scene.origin;
  if (!origin.geographic || !origin.has_map_offset) return;
  const auto on_map = geographic_position(parts.info.map_projection, math::Point3{} + parts.map_offset_m);
  if (!on_map) return;
  const double latitude = origin.geographic->latitude_rad, longitude = origin.geographic->longitude_rad;
  const double apart_m = length(geodesy::ecef_from_geodetic({latitude, longitude}) -
                                geodesy::ecef_from_geodetic({on_map->latitude_deg * math::kDegree,
                                                             on_map->longitude_deg * math::kDegree}));
  if (apart_m < kNoticed_m) return;
  log.warn(format(
      "the origin's latitude {:.4g} and longitude {:.4g} deg lie {:.0f} km from its easting and northing, which are at "
      "latitude {:.4g} and longitude {:.4g} deg: the Sun follows the first, the map the second. Correct one, or leave "
      "'latitude' and 'longitude' away",
      latitude / math::kDegree, longitude / math::kDegree, apart_m / 1000.0, on_map->latitude_deg,
      on_map->longitude_deg));
}

}  // namespace

void warn_of_locations(const Parts& parts, const SceneSurvey& survey, LogSink& log) {
  warn_of_degrees(parts, log);
  warn_of_two_origins(parts, log);
  warn_of_camera(parts, survey, log);
  warn_of_far_objects(parts, survey, log);
  warn_of_objects_out_of_view(parts, survey, log);
  warn_of_sizes(parts, survey, log);
  warn_of_maps(parts, survey, log);
  warn_of_shared_locations(parts, survey, log);
}

}  // namespace ifov::session
