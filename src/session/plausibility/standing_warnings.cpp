#include <algorithm>
#include <cmath>
#include <optional>

#include "core/format.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "io/document/shapes/flat_primitives.h"
#include "session/loaded/parts.h"
#include "session/plausibility/plausibility_warnings.h"

namespace ifov::session {
namespace {

constexpr double kStep_m = 0.3;  // from here the ray down starts, above what a thing stands on
constexpr double kGap_m = 0.5, kGapOfHeight = 0.1;
constexpr double kGapOfCopies = 1.0;     // of their height: crowns are placed without their trunks
constexpr double kGapOfCities_m = 5.0;   // streets of a model in space stand above a plane below them all
constexpr double kTouch_m = 0.1;         // how far a thing may be from what it hangs on
constexpr std::uint32_t kSurveyed = 64;  // copies of an object
constexpr int kMostLayers = 64;

bool is_copied(const io::ObjectDocument& object) {
  return std::holds_alternative<io::InstanceShape>(object.shape) ||
         std::holds_alternative<io::InstancesShape>(object.shape);
}

/// Things that stand: what may hang in the air on purpose (a roof, a ball) is not looked at.
bool stands(const io::ObjectDocument& object) {
  return std::holds_alternative<io::MeshShape>(object.shape) ||
         std::holds_alternative<io::CityShape>(object.shape) || is_copied(object);
}

bool is_ground(const io::Document& document, std::size_t object) {
  if (object >= document.scene.objects.size()) return false;
  const io::ShapeDocument& shape = document.scene.objects[object].shape;
  return io::is_primitive(shape, io::PlanePrimitive::kModel) ||
         std::holds_alternative<io::TerrainShape>(shape);
}

struct Standing {
  double height_m = 0.0;        ///< of the thing
  std::optional<double> gap_m;  ///< from its lowest point down to what is below its middle; none: nothing is
  std::optional<double> under_m;  ///< by so much ground lies above its highest point
};

/// Whether something else than an object's own pieces is within its box or close by: a window hangs on a wall. Looked for from the
/// middle towards all sides.
bool touches(const Parts& parts, std::uint32_t placed, std::size_t of) {
  const geometry::World& world = *parts.scene.world;
  const geometry::World::PlacedObject object = world.object(placed);
  for (std::size_t k = 0; k < 3; ++k) {
    // A flat thing is thin along its normal.
    const math::Vec3 half = object.half_sides_m[k],
                     across = math::cross(object.half_sides_m[(k + 1) % 3], object.half_sides_m[(k + 2) % 3]);
    const double length_m = math::length(half);
    const math::Vec3 along = length_m > 0.0 ? half : across;
    if (!(math::length(along) > 0.0)) continue;
    for (const double sign : {-1.0, 1.0}) {
      math::Ray ray{object.centre_m, sign * math::normalized(along)};
      ray.t_max_m = length_m + kTouch_m;
      for (int layer = 0; layer < kMostLayers; ++layer) {
        geometry::SurfacePoint hit;
        world.intersect({&ray, 1}, {&hit, 1});
        if (!hit.hit()) break;
        if (parts.placed.of(hit.instance) != of) return true;
        ray.t_min_m = hit.distance_m + std::max(1e-6, hit.offset_m);
      }
    }
  }
  return false;
}

Standing survey_around(const Parts& parts, std::uint32_t placed) {
  const geometry::World& world = *parts.scene.world;
  const geometry::World::PlacedObject object = world.object(placed);
  double half_m = 0.0;
  for (const math::Vec3& side : object.half_sides_m) half_m += std::abs(side.z);
  Standing standing{2.0 * half_m, {}, {}};
  math::Ray down{{object.centre_m.x, object.centre_m.y, object.centre_m.z - half_m + kStep_m},
                 {0.0, 0.0, -1.0}};
  for (int layer = 0; layer < kMostLayers; ++layer) {
    geometry::SurfacePoint hit;
    world.intersect({&down, 1}, {&hit, 1});
    if (!hit.hit()) break;
    if (hit.instance != placed) {
      standing.gap_m = hit.distance_m - kStep_m;
      break;
    }
    down.t_min_m = hit.distance_m + std::max(1e-6, hit.offset_m);
  }
  const math::Ray up{{object.centre_m.x, object.centre_m.y, object.centre_m.z + half_m}, {0.0, 0.0, 1.0}};
  geometry::SurfacePoint above;
  world.intersect({&up, 1}, {&above, 1});
  if (above.hit() && !above.front && is_ground(parts.document, parts.placed.of(above.instance)))
    standing.under_m = above.distance_m;
  return standing;
}

}  // namespace

void warn_of_standing(const Parts& parts, LogSink& log) {
  if (parts.scene.world->storage().chunks > 0) return;
  bool has_ground = false;
  for (std::size_t d = 0; d < parts.placed.document_objects(); ++d)
    has_ground = has_ground || is_ground(parts.document, d);
  if (!has_ground) return;
  for (std::size_t d = 0; d < parts.placed.document_objects(); ++d) {
    if (!stands(parts.document.scene.objects[d])) continue;
    const std::uint32_t count = parts.placed.count(d), step = count / kSurveyed + 1;
    std::uint32_t surveyed = 0, floating = 0, buried = 0;
    double widest_m = 0.0, deepest_m = 0.0;
    const bool is_city = std::holds_alternative<io::CityShape>(parts.document.scene.objects[d].shape);
    const double least_gap_m = is_city ? kGapOfCities_m : kGap_m;
    const double gap_of_height = is_copied(parts.document.scene.objects[d]) ? kGapOfCopies : kGapOfHeight;
    for (std::uint32_t k = 0; k < count; k += step) {
      const Standing one = survey_around(parts, parts.placed.first(d) + k);
      ++surveyed;
      if (one.gap_m && *one.gap_m > std::max(least_gap_m, gap_of_height * one.height_m) &&
          !touches(parts, parts.placed.first(d) + k, d))
        ++floating, widest_m = std::max(widest_m, *one.gap_m);
      if (one.under_m) ++buried, deepest_m = std::max(deepest_m, *one.under_m);
    }
    const auto which = [&](std::uint32_t some) {
      return count == 1 ? title_of(parts.document.scene.objects, d)
                        : format("{}: {} of {} copies that were looked at",
                                 title_of(parts.document.scene.objects, d), some, surveyed);
    };
    if (2 * floating > surveyed)
      log.warn(format("{} float{} up to {:.3g} m above what is below: is the height right?", which(floating),
                      count == 1 ? "s" : "", widest_m));
    if (2 * buried > surveyed)
      log.warn(format("{} lie{} under the ground, up to {:.3g} m deep: is the height right?", which(buried),
                      count == 1 ? "s" : "", deepest_m));
  }
}

}  // namespace ifov::session
