#include "landscape/output/scene_maker.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/format.h"
#include "io/document/document.h"
#include "landscape/output/material_table.h"
#include "math/angle.h"

namespace ifov::landscape {
namespace {

double rounded(double value, int decimals) { return std::stod(format("{:.{}f}", value, decimals)); }

}  // namespace

double to_millimetre(double value_m) { return rounded(value_m, 3); }

math::Point3 to_millimetre(math::Point3 point_m) {
  return {to_millimetre(point_m.x), to_millimetre(point_m.y), to_millimetre(point_m.z)};
}

io::ObjectDocument mesh_object(const std::string& name, const std::string& file,
                               io::MaterialBinding material) {
  io::ObjectDocument object;
  object.name = name;
  object.shape = io::MeshShape{{file, {}}, 1.0, {}};
  object.material = std::move(material);
  return object;
}

io::ObjectDocument moved(io::ObjectDocument object, math::Point3 to_m) {
  const math::Point3 to = to_millimetre(to_m);
  object.transform.translate_m = {to.x, to.y, to.z};
  return object;
}

io::ObjectDocument standing(io::ObjectDocument object, const Stand& stand, double z_m) {
  object = moved(std::move(object), {stand.origin.x, stand.origin.y, z_m});
  object.transform.rotation_rad = rounded(stand.rotation_rad() * 180.0 / M_PI, 3) * math::kDegree;
  return object;
}

io::DocumentName SceneMaker::material(const std::string& name) {
  auto& known = scene_.materials;
  const bool is_new =
      std::none_of(known.begin(), known.end(), [&](const auto& one) { return one.name == name; });
  if (is_new) known.push_back(table_material(name, folder_));
  return {name, {}};
}

io::MaterialBinding SceneMaker::slots(const std::vector<std::pair<std::string, std::string>>& materials) {
  io::MaterialSlots slots;
  for (const auto& [slot, name] : materials) slots.slots.emplace_back(slot, material(name));
  return {std::move(slots), {}};
}

io::MaterialBinding SceneMaker::classes(const std::string& map_file, double half_m,
                                        const std::vector<std::string>& materials) {
  io::MaterialMap map;
  map.raster.file.path = map_file;
  const double low = to_millimetre(-half_m), size = to_millimetre(2.0 * half_m);
  map.raster.placement = io::RasterDocument::Placement{low, low, size, size};
  for (std::size_t k = 0; k < materials.size(); ++k)
    map.classes.emplace_back(static_cast<std::int64_t>(k) + 1, material(materials[k]));
  return {std::move(map), {}};
}

void SceneMaker::prototype(const std::string& name, std::vector<io::ObjectDocument> objects) {
  scene_.prototypes.push_back({name, std::move(objects), {}});
}

std::string SceneMaker::document(std::string_view title, const io::LightDocument& light,
                                 const io::AtmosphereDocument& atmosphere) const {
  io::Document whole;
  whole.scene = scene_;
  whole.light = light;
  whole.atmosphere = atmosphere;
  return io::document_text(
      whole, kSceneFile,
      {.comment = format("{}\nThe scene and its light, which the documents beside this one include.\n"
                         "Temperatures are those of a calm, clear early afternoon in summer.",
                         title),
       .sections = {"scene", "light", "atmosphere"}});
}

}  // namespace ifov::landscape
