#include "session/assembly/geometry/city_assembly.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <set>

#include "core/names.h"
#include "geometry/world/world_builder.h"
#include "io/city/city_json_reader.h"
#include "io/document/scene_document.h"
#include "session/assembly/shared/map_frame.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/surfaces/assignment_assembly.h"

namespace ifov::session {
namespace {

/// Beyond this distance from the scene's origin a city is most likely misplaced.
constexpr double kFarAway_m = 20e3;

/// "EPSG:7415" of "https://www.opengis.net/def/crs/EPSG/0/7415" and of "urn:ogc:def:crs:EPSG::7415"; empty
/// where the name is of another kind.
std::string epsg_code(const std::string& system) {
  if (system.find("EPSG") == std::string::npos) return {};
  std::size_t begin = system.size();
  while (begin > 0 && std::isdigit(static_cast<unsigned char>(system[begin - 1]))) --begin;
  return begin == system.size() ? std::string() : "EPSG:" + system.substr(begin);
}

/// Which of the entries of `slots` covers each slot of an object, and under which name the binding knows it.
std::vector<std::uint32_t> materials_of(const io::ObjectDocument& object, const io::CityObject& thing,
                                        const io::DocumentSources& sources, AssignmentAssembly& assignments) {
  std::vector<std::string> names;
  const auto* slots = std::get_if<io::MaterialSlots>(&object.material->value);
  if (slots != nullptr)
    for (const auto& entry : slots->slots) names.push_back(entry.first);
  std::vector<std::uint32_t> materials;
  for (const std::string& slot : thing.mesh.slot_names) {
    const std::string* name = slots != nullptr ? io::city_slot(thing, slot, names) : &slot;
    if (name == nullptr)
      throw io::document_error(
          sources, object.material->position,
          format("no material for the surfaces '{}' of the {} '{}'; give one for '{}', '{}' or 'other'", slot,
                 thing.type, thing.id, slot, thing.type));
    materials.push_back(assignments.assignment(*object.material, *name, object.temperature));
  }
  return materials;
}

/// Types of objects and of surfaces in CityJSON 2.0: rules may name what this model has none of.
constexpr const char* kTypes[] = {"Bridge",
                                  "BridgePart",
                                  "Building",
                                  "BuildingPart",
                                  "CityFurniture",
                                  "GenericCityObject",
                                  "LandUse",
                                  "OtherConstruction",
                                  "PlantCover",
                                  "Railway",
                                  "Road",
                                  "SolitaryVegetationObject",
                                  "TINRelief",
                                  "TransportSquare",
                                  "Tunnel",
                                  "TunnelPart",
                                  "WaterBody",
                                  "Waterway",
                                  "AuxiliaryTrafficArea",
                                  "CeilingSurface",
                                  "ClosureSurface",
                                  "Door",
                                  "FloorSurface",
                                  "GroundSurface",
                                  "InteriorWallSurface",
                                  "OuterCeilingSurface",
                                  "OuterFloorSurface",
                                  "RoofSurface",
                                  "TrafficArea",
                                  "TransportationHole",
                                  "TransportationMarking",
                                  "WallSurface",
                                  "WaterClosureSurface",
                                  "WaterGroundSurface",
                                  "WaterSurface",
                                  "Window",
                                  "other"};

void warn_of_misspelt_rules(const std::string& file, const io::MaterialSlots& given,
                            const io::CityModel& model, LogSink& log) {
  std::set<std::string> known(std::begin(kTypes), std::end(kTypes));
  for (const io::CityObject& thing : model.objects) {
    known.insert(thing.type);
    known.insert(thing.mesh.slot_names.begin(), thing.mesh.slot_names.end());
  }
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& entry : given.slots) {
    if (known.contains(entry.first) || entry.first.find_first_of("[/") != std::string::npos) continue;
    const std::string guess = nearest_name(entry.first, names);
    if (!guess.empty())
      log.warn(format("city '{}': 'slots' has '{}', which no surface is; is '{}' meant?", file, entry.first,
                      guess));
  }
}

/// Takes the model from its own projection to the scene's.
void take_over(io::CityModel& model, const io::MapTransform& scene_from_file) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  model.low.x = model.low.y = kInfinity, model.high.x = model.high.y = -kInfinity;
  const auto include = [&](double x, double y) {
    model.low.x = std::min(model.low.x, x), model.high.x = std::max(model.high.x, x);
    model.low.y = std::min(model.low.y, y), model.high.y = std::max(model.high.y, y);
  };
  for (io::CityObject& thing : model.objects) {
    std::vector<io::MapPoint> points;
    points.reserve(thing.mesh.vertices_m.size() + 1);
    points.push_back({thing.origin.x, thing.origin.y});
    for (const math::Point3& p : thing.mesh.vertices_m)
      points.push_back({thing.origin.x + p.x, thing.origin.y + p.y});
    scene_from_file.apply(points);
    thing.origin.x = points[0].x, thing.origin.y = points[0].y;
    for (std::size_t k = 0; k < thing.mesh.vertices_m.size(); ++k) {
      include(points[k + 1].x, points[k + 1].y);
      thing.mesh.vertices_m[k].x = points[k + 1].x - points[0].x;
      thing.mesh.vertices_m[k].y = points[k + 1].y - points[0].y;
    }
  }
}

void report(const std::string& file, const io::CityModel& model, math::Point3 centre, LogSink& log) {
  std::size_t buildings = 0, triangles = 0;
  for (const io::CityObject& thing : model.objects) {
    buildings += thing.type == "Building" ? 1 : 0;
    triangles += thing.mesh.triangles.size();
  }
  log.info(format(
      "city '{}': CityJSON {}, {}, {} objects ({} buildings), {} surfaces in {} triangles, east {:.3f} to "
      "{:.3f}, north {:.3f} to {:.3f}, height {:.3f} to {:.3f} m",
      file, model.version,
      model.reference_system.empty() ? "no reference system stated" : model.reference_system,
      model.objects.size(), buildings, model.surfaces, triangles, model.low.x, model.high.x, model.low.y,
      model.high.y, model.low.z, model.high.z));
  const auto warn_of = [&](std::size_t count, const char* what) {
    if (count > 0) log.warn(format("city '{}': {} {}", file, count, what));
  };
  warn_of(model.repaired_surfaces, "surfaces whose outlines cross were made valid");
  if (model.empty_surfaces > 0)  // nothing is lost by it
    log.info(format("city '{}': {} surfaces without area are left out", file, model.empty_surfaces));
  warn_of(model.lines_and_points, "geometries of points or lines are left out");
  warn_of(model.objects_without_lod, "objects do not have the level of detail asked for and are left out");
  const double distance_m = std::hypot(centre.x, centre.y);
  if (distance_m > kFarAway_m)
    log.warn(
        format("city '{}' lies {:.0f} km from the scene's origin; state its easting and northing as 'origin'",
               file, distance_m / 1000.0));
}

}  // namespace

void place_city(const io::DocumentSources& sources, const io::ObjectDocument& object,
                const math::Transform& scene_from_document, const MapFrame& frame,
                AssignmentAssembly& assignments, geometry::WorldBuilder& builder, LogSink* log) {
  const io::CityShape& shape = std::get<io::CityShape>(object.shape);
  // The object's transform is about the document's coordinates, the model's are on the map.
  const math::Transform scene_from_map =
      scene_from_document * math::Transform::translation(frame.document_offset_m() - frame.offset_m());
  io::CityModel model = with_position(sources, shape.file.position, [&] {
    io::CityModel read = io::read_city_json(shape.file.path, {shape.lod, shape.types});
    const std::string code = epsg_code(read.reference_system);
    if (frame.reference() == nullptr || code.empty()) return read;
    if (const auto scene_from_file = frame.transform_from(code, shape.file.path)) {
      const math::Point3 before = read.low;
      take_over(read, *scene_from_file);
      if (log != nullptr)
        log->info(format(
            "city '{}': its file says {}, the scene '{}': taken from east {:.3f}, north {:.3f} to east {:.3f}, "
            "north {:.3f} m (its lower left corner)",
            shape.file.path, code, frame.reference()->name(), before.x, before.y, read.low.x, read.low.y));
    }
    return read;
  });
  if (log != nullptr) {
    const math::Vec3 half = (model.high - model.low) * 0.5;
    report(shape.file.path, model, scene_from_map(model.low + half), *log);
    if (const auto* slots = std::get_if<io::MaterialSlots>(&object.material->value))
      warn_of_misspelt_rules(shape.file.path, *slots, model, *log);
  }
  for (io::CityObject& thing : model.objects) {
    const std::vector<std::uint32_t> materials = materials_of(object, thing, sources, assignments);
    // Roads, lawns and water are parts of the ground, not things that a sensor may miss.
    const bool pilot_ray = object.pilot_ray.value_or(thing.type.starts_with("Building"));
    const math::Transform scene_from_thing =
        scene_from_map * math::Transform::translation(thing.origin - math::Point3{});
    builder.place(builder.add_shape(std::move(thing.mesh)), scene_from_thing, materials, pilot_ray);
  }
}

}  // namespace ifov::session
