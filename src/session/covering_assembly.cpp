#include "session/covering_assembly.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "io/raster/raster.h"
#include "session/spectrum_assembly.h"
#include "session/with_position.h"

namespace ifov::session {

namespace {

materials::MapGrid grid_of(const io::RasterDocument& source, const io::Raster& raster, math::Vec3 offset_m) {
  materials::MapGrid grid;
  grid.width = raster.width;
  grid.height = raster.height;
  if (source.placement) {
    const io::RasterDocument::Placement& place = *source.placement;
    grid.cell_width_m = place.width_m / raster.width;
    grid.cell_height_m = place.height_m / raster.height;
    grid.west_m = place.x_m;
    grid.north_m = place.y_m + place.height_m;
  } else if (raster.geotransform) {
    const std::array<double, 6>& t = *raster.geotransform;
    if (t[2] != 0.0 || t[4] != 0.0 || t[1] <= 0.0 || t[5] >= 0.0)
      throw InputError(format("the raster '{}' is not north up; warp it first, or give low_left and size",
                              source.file.path));
    grid.cell_width_m = t[1];
    grid.cell_height_m = -t[5];
    grid.west_m = t[0];
    grid.north_m = t[3];
  } else {
    throw InputError(format("the raster '{}' has no georeference; give low_left and size", source.file.path));
  }
  grid.west_m -= offset_m.x;
  grid.north_m -= offset_m.y;
  return grid;
}

std::string key_of(const io::RasterDocument& source, math::Vec3 offset_m, const std::string& more) {
  std::string key = format("{}|{},{}|{}", source.file.path, offset_m.x, offset_m.y, more);
  if (source.placement)
    key += format("|{},{},{},{}", source.placement->x_m, source.placement->y_m, source.placement->width_m,
                  source.placement->height_m);
  return key;
}

}  // namespace

CoveringAssembly::CoveringAssembly(const io::Document& document, scene::Scene& scene)
    : document_(document), scene_(scene) {
  for (const io::MaterialDocument& source : document.scene.materials) {
    materials::Material material;
    material.name = source.name;
    const radiometry::Spectrum spectrum =
        assemble_spectrum(document, source.spectrum, format("the spectrum of material '{}'", source.name));
    material.reflectance = source.is_emissivity ? spectrum.complement() : spectrum;
    material.scattering = source.scattering == io::Scattering::mirror ? materials::ScatteringKind::mirror
                                                                       : materials::ScatteringKind::lambertian;
    if (source.temperature)
      if (const double* fixed_k = std::get_if<double>(&source.temperature->value)) material.temperature_k = *fixed_k;
    with_position(document, source.position, [&] { materials::check(material); });
    scene_.materials.push_back(std::move(material));
  }
}

std::uint32_t CoveringAssembly::covering(const io::MaterialBinding& binding, const std::string& slot_name,
                                         const std::optional<io::TemperatureDocument>& temperature,
                                         math::Vec3 draped_offset_m) {
  scene::Covering covering;
  if (const auto* name = std::get_if<io::DocumentName>(&binding.value)) {
    add_state(covering, *name, temperature, draped_offset_m);
  } else if (const auto* slots = std::get_if<io::MaterialSlots>(&binding.value)) {
    const auto found = std::find_if(slots->slots.begin(), slots->slots.end(),
                                    [&](const auto& slot) { return slot.first == slot_name; });
    if (found == slots->slots.end()) {
      std::string names;
      for (const auto& slot : slots->slots) names += (names.empty() ? "'" : ", '") + slot.first + "'";
      throw io::document_error(document_, binding.position,
                               format("no material for slot '{}' of the mesh; the slots given are {}", slot_name,
                                      names.empty() ? "none" : names));
    }
    add_state(covering, found->second, temperature, draped_offset_m);
  } else {
    const io::MaterialMap& map = std::get<io::MaterialMap>(binding.value);
    with_position(document_, binding.position, [&] { add_classes(covering, map, draped_offset_m); });
    for (const auto& entry : map.classes) add_state(covering, entry.second, temperature, draped_offset_m);
  }
  return add(std::move(covering));
}

void CoveringAssembly::add_classes(scene::Covering& covering, const io::MaterialMap& map, math::Vec3 offset_m) {
  std::string classes_text;
  for (const auto& entry : map.classes) classes_text += format("{}{}", classes_text.empty() ? "" : ", ", entry.first);
  std::shared_ptr<const materials::ClassMap>& shared = class_maps_[key_of(map.raster, offset_m, classes_text)];
  if (!shared) {
    const io::Raster raster = io::read_raster(map.raster.file.path);
    std::vector<std::uint16_t> classes(static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height));
    for (int row = 0; row < raster.height; ++row)
      for (int column = 0; column < raster.width; ++column) {
        const float value = raster.at(0, row, column);
        const auto found = std::lower_bound(
            map.classes.begin(), map.classes.end(), value,
            [](const auto& entry, float v) { return static_cast<double>(entry.first) < static_cast<double>(v); });
        if (found == map.classes.end() || static_cast<double>(found->first) != static_cast<double>(value))
          throw InputError(format("class {} at row {}, column {} of '{}' has no material; the classes given are {}",
                                  value, row + 1, column + 1, map.raster.file.path, classes_text));
        classes[static_cast<std::size_t>(row) * static_cast<std::size_t>(raster.width) +
                static_cast<std::size_t>(column)] = static_cast<std::uint16_t>(found - map.classes.begin());
      }
    shared = std::make_shared<materials::ClassMap>(grid_of(map.raster, raster, offset_m), std::move(classes));
  }
  covering.classes = shared;
}

void CoveringAssembly::add_state(scene::Covering& covering, const io::DocumentName& material,
                                 const std::optional<io::TemperatureDocument>& temperature, math::Vec3 offset_m) {
  const std::uint32_t index = material_index(material.name);
  const Temperature found = temperature_of(index, temperature, offset_m);
  covering.states.push_back(state({index, found.fixed_k}));
  covering.temperatures.push_back(found.map);
}

CoveringAssembly::Temperature CoveringAssembly::temperature_of(
    std::uint32_t material, const std::optional<io::TemperatureDocument>& override_with, math::Vec3 offset_m) {
  const std::optional<io::TemperatureDocument>& source =
      override_with ? override_with : document_.scene.materials[material].temperature;
  Temperature result;
  if (!source) return result;
  if (const double* fixed_k = std::get_if<double>(&source->value)) {
    result.fixed_k = *fixed_k;
    return result;
  }
  const io::TemperatureMap& map = std::get<io::TemperatureMap>(source->value);
  std::shared_ptr<const materials::TemperatureMap>& shared =
      temperature_maps_[key_of(map.raster, offset_m, format("{}", map.offset_k))];
  if (!shared)
    with_position(document_, source->position, [&] {
      io::Raster raster = io::read_raster(map.raster.file.path);
      const std::size_t cells = static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height);
      raster.values.resize(cells);
      for (float& value : raster.values) value += static_cast<float>(map.offset_k);
      shared = std::make_shared<materials::TemperatureMap>(grid_of(map.raster, raster, offset_m),
                                                           std::move(raster.values));
    });
  result.map = shared;
  return result;
}

std::uint32_t CoveringAssembly::material_index(const std::string& name) const {
  for (std::size_t m = 0; m < document_.scene.materials.size(); ++m)
    if (document_.scene.materials[m].name == name) return static_cast<std::uint32_t>(m);
  throw InputError(format("there is no material '{}'", name));
}

std::uint32_t CoveringAssembly::state(scene::SurfaceState wanted) {
  const auto found = std::find(scene_.states.begin(), scene_.states.end(), wanted);
  const auto index = static_cast<std::uint32_t>(found - scene_.states.begin());
  if (found == scene_.states.end()) scene_.states.push_back(wanted);
  return index;
}

std::uint32_t CoveringAssembly::add(scene::Covering covering) {
  const bool mapped = std::any_of(covering.temperatures.begin(), covering.temperatures.end(),
                                  [](const auto& map) { return map != nullptr; });
  if (!mapped) covering.temperatures.clear();
  for (std::size_t k = 0; k < scene_.coverings.size(); ++k)
    if (scene_.coverings[k] == covering) return static_cast<std::uint32_t>(k);
  scene_.coverings.push_back(std::move(covering));
  return static_cast<std::uint32_t>(scene_.coverings.size() - 1);
}

}  // namespace ifov::session
