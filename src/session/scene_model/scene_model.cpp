#include "session/scene_model/scene_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/call_scope.h"
#include "core/version.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "io/json/document_parts.h"
#include "io/scene_cache/scene_cache.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "session/assembly/whole/light_assembly.h"
#include "session/assembly/whole/scene_assembly.h"
#include "session/assembly/whole/sensor_assembly.h"
#include "session/one_material.h"
#include "session/scene_model/surface_colours.h"

namespace ifov::session {

using radiometry::LinearRgb;

struct SceneModel::Inside {
  std::unique_ptr<const io::Document> document;
  AssembledScene assembled;
  std::vector<std::size_t> numbers;  ///< of its objects in the document as it is written
  std::vector<DocumentFault> faults;
  std::string statement;
  std::optional<math::Vec3> sun;
  std::optional<SensorSketch> sensor;
  std::vector<LinearRgb> colours;  ///< by material
  SurfacePaint usual = SurfacePaint::reflectance;

  const scene::Scene& scene() const { return assembled.scene; }
  std::size_t placed_object(const geometry::SurfacePoint& point) const {
    return assembled.placed.of(point.instance);
  }
  std::int32_t object_of(const geometry::SurfacePoint& point) const {
    const std::size_t object = placed_object(point);
    return object < numbers.size() ? static_cast<std::int32_t>(numbers[object]) : -1;
  }
  LinearRgb colour(const geometry::SurfacePoint& point, SurfacePaint paint) const;
};

namespace {

/// The places of a list's items that the document has; cuts take some away.
std::vector<std::size_t> numbers_left(std::size_t left, std::span<const io::DocumentOverride> overrides) {
  std::vector<std::size_t> gone;
  for (const io::DocumentOverride& one : overrides)
    if (one.steps.size() == 3 && one.steps[1].key == "objects" && one.value == "null")
      gone.push_back(one.steps[2].index);
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; numbers.size() < left; ++k)
    if (std::find(gone.begin(), gone.end(), k) == gone.end()) numbers.push_back(k);
  return numbers;
}

bool has_sensor(std::span<const DocumentFault> faults) {
  return std::none_of(faults.begin(), faults.end(),
                      [](const DocumentFault& fault) { return fault.instead == "no sensor is shown"; });
}

/// Whether eyes would tell the materials apart.
SurfacePaint usual_paint_of(const scene::Scene& scene, const std::vector<LinearRgb>& colours) {
  constexpr double kApart = 12.0;  // Delta E*ab
  for (const LinearRgb& one : colours)
    if (radiometry::colour_difference(one, colours.front()) > kApart) return SurfacePaint::reflectance;
  return scene.materials.size() > 1 ? SurfacePaint::material : SurfacePaint::reflectance;
}

std::uint32_t coded(const LinearRgb& colour, double shade) {
  std::uint32_t code = 0;
  for (const double value : colour)
    code = code << 8U | static_cast<std::uint32_t>(
                            std::lround(255.0 * radiometry::srgb_coded(std::clamp(value * shade, 0.0, 1.0))));
  return code;
}

math::Vec3 seen_normal(const geometry::SurfacePoint& point) {
  const math::Vec3 normal = point.shading_normal.as_vector();
  return point.front ? normal : -normal;
}

}  // namespace

LinearRgb SceneModel::Inside::colour(const geometry::SurfacePoint& point, SurfacePaint paint) const {
  if (paint == SurfacePaint::object) return distinct_colour(placed_object(point));
  const scene::ResolvedSurface surface = scene().resolve_without_temperature(point);
  LinearRgb colour{};
  for (const scene::Constituent& one : surface) {
    // Further curves of a material are that material.
    const std::size_t material = scene().materials[one.material].curve_of.value_or(one.material);
    const LinearRgb own = paint == SurfacePaint::material ? distinct_colour(material) : colours[one.material];
    for (std::size_t c = 0; c < 3; ++c) colour[c] += one.weight * own[c];
  }
  return colour;
}

SceneModel::SceneModel(std::unique_ptr<const Inside> inside) : inside_(std::move(inside)) {}
SceneModel::~SceneModel() = default;

std::unique_ptr<const SceneModel> SceneModel::load(const std::string& file,
                                                   std::span<const io::DocumentOverride> overrides,
                                                   ProgressSink* progress,
                                                   std::vector<DocumentFault>* faults) {
  const auto phase = [&](const char* what) {
    if (progress != nullptr) progress->phase(what);
  };
  phase("the document");
  DocumentCuts cuts(io::read_document_text(file), file, overrides);
  auto inside = std::make_unique<Inside>();
  std::vector<DocumentFault> own;
  std::vector<DocumentFault>& left_out = faults != nullptr ? *faults : own;
  while (true) {
    try {
      inside->document =
          std::make_unique<const io::Document>(io::parse_document(cuts.text(), file, cuts.overrides()));
      const io::Document& document = *inside->document;
      // What another call has kept is used; nothing is kept here.
      io::SceneCache cache(std::filesystem::path(file).replace_extension(".ifovcache"), version(), nullptr);
      inside->assembled =
          assemble_scene(document.sources, document.scene, document.light.lamps, document.time,
                         document.sensor.camera, document.seed, nullptr, &cache, progress);
      break;
    } catch (const InputError& error) {
      stop_if_cancelled();
      const auto fault = cuts.cut_out(error);
      if (!fault) throw;
      left_out.push_back(*fault);
    }
  }
  const io::Document& document = *inside->document;
  const geometry::World& world = *inside->assembled.scene.world;
  inside->numbers = numbers_left(document.scene.objects.size(), cuts.overrides());
  inside->statement = scene_statement(world);
  for (std::size_t m = 0; m < inside->scene().materials.size(); ++m)
    inside->colours.push_back(visible_colour(inside->scene().materials[m], m));
  inside->usual = usual_paint_of(inside->scene(), inside->colours);
  phase("the light");
  try {
    assemble_light({document.sources, document.light, document.atmosphere, document.scene.origin,
                    document.time, surroundings_material(document)},
                   inside->assembled.scene);
    if (inside->scene().sun && inside->scene().sun->is_up()) inside->sun = inside->scene().sun->direction;
  } catch (const InputError& error) {
    left_out.push_back({error.what(), error.position(), "no Sun is shown"});
  }
  try {
    if (has_sensor(left_out))
      inside->sensor = sketch_of(*assemble_camera(document.sources, document.sensor.camera,
                                                  document.scene.origin, world, document.seed),
                                 world);
  } catch (const InputError& error) {
    left_out.push_back({error.what(), error.position(), "no sensor is shown"});
  }
  inside->faults = left_out;
  return std::unique_ptr<const SceneModel>(new SceneModel(std::move(inside)));
}

const std::vector<DocumentFault>& SceneModel::faults() const { return inside_->faults; }
const std::string& SceneModel::statement() const { return inside_->statement; }
math::Vec3 SceneModel::offset_m() const { return inside_->assembled.map_offset_m; }
const std::optional<math::Vec3>& SceneModel::sun() const { return inside_->sun; }
const std::optional<SensorSketch>& SceneModel::sensor() const { return inside_->sensor; }
SurfacePaint SceneModel::usual_paint() const { return inside_->usual; }

std::optional<std::array<math::Point3, 2>> SceneModel::bounds_m() const {
  const geometry::World::Bounds box = inside_->scene().world->bounds();
  const bool is_there =
      box.low_m.x <= box.high_m.x && box.low_m.y <= box.high_m.y && box.low_m.z <= box.high_m.z;
  const double sum = box.low_m.x + box.low_m.y + box.low_m.z + box.high_m.x + box.high_m.y + box.high_m.z;
  if (!is_there || !std::isfinite(sum)) return std::nullopt;
  return std::array{box.low_m, box.high_m};
}

void SceneModel::look(std::span<const math::Ray> rays, SurfacePaint paint, std::span<Seen> seen) const {
  constexpr double kAmbient = 0.42, kDirect = 0.58;  // of the light on a surface that faces it
  const geometry::World& world = *inside_->scene().world;
  std::vector<geometry::SurfacePoint> points(rays.size());
  world.intersect(rays, points);
  std::vector<double> facing(rays.size(), 0.0);
  std::vector<math::Ray> towards_sun;
  std::vector<std::size_t> of;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    if (!points[k].hit()) continue;
    const math::Vec3 normal = seen_normal(points[k]);
    if (!inside_->sun) {
      facing[k] = std::abs(math::dot(normal, rays[k].direction));
      continue;
    }
    facing[k] = std::max(0.0, math::dot(normal, *inside_->sun));
    if (!(facing[k] > 0.0)) continue;
    const double side = points[k].front ? points[k].offset_m : -points[k].offset_m;
    towards_sun.push_back(
        rays[k].onward(points[k].position_m + points[k].geometric_normal.as_vector() * side, *inside_->sun));
    of.push_back(k);
  }
  std::vector<std::uint8_t> blocked(towards_sun.size());
  if (!towards_sun.empty()) world.occluded(towards_sun, blocked);
  for (std::size_t j = 0; j < of.size(); ++j)
    if (blocked[j] != 0) facing[of[j]] = 0.0;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    if (!points[k].hit()) {
      seen[k] = {std::numeric_limits<float>::quiet_NaN(), 0, -1};
      continue;
    }
    // Where no Sun is, or it leaves a surface in the shade, form is told by how it faces the eye.
    const double form = 0.75 + 0.25 * std::abs(math::dot(seen_normal(points[k]), rays[k].direction));
    seen[k] = {static_cast<float>(points[k].distance_m),
               coded(inside_->colour(points[k], paint), kAmbient * form + kDirect * facing[k]),
               inside_->object_of(points[k])};
  }
}

std::optional<SceneModel::Picked> SceneModel::pick(const math::Ray& ray) const {
  geometry::SurfacePoint point;
  inside_->scene().world->intersect(std::span(&ray, 1), std::span(&point, 1));
  if (!point.hit()) return std::nullopt;
  Picked picked;
  picked.distance_m = point.distance_m;
  picked.position_m = point.position_m;
  const math::Vec3 normal = point.geometric_normal.as_vector();
  picked.normal = point.front ? normal : -normal;
  picked.object = inside_->object_of(point);
  const auto& objects = inside_->document->scene.objects;
  if (const std::size_t object = inside_->placed_object(point); object < objects.size()) {
    picked.name = objects[object].name.empty() ? "a " + kind_of(objects[object]) : objects[object].name;
    picked.line = objects[object].position.line;
    picked.file = objects[object].position.file;
  } else {
    picked.name = "a lamp";
  }
  for (const scene::Constituent& one : inside_->scene().resolve_without_temperature(point))
    picked.materials.push_back({inside_->scene().materials[one.material].name, one.weight});
  std::sort(picked.materials.begin(), picked.materials.end(),
            [](const Picked::Share& a, const Picked::Share& b) { return a.weight > b.weight; });
  return picked;
}

}  // namespace ifov::session
