#include "session/assembly/surfaces/assignment_assembly.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>

#include "core/overloaded.h"
#include "io/raster/fill_unknown.h"
#include "materials/bsdf/bsdf.h"
#include "materials/bsdf/hemisphere.h"
#include "scene/level_pattern.h"
#include "scene/map_patterns.h"
#include "scene/scene.h"
#include "session/assembly/shared/spectrum_assembly.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

/// What is seen otherwise from behind is smooth and of one kind.
void check_two_sided(const io::MaterialDocument& source) {
  const auto refuse = [&](const char* what) {
    throw InputError(
        format("material '{}': {} cannot be on a '{}' surface that is seen otherwise from its inner side",
               source.name, what, source.scattering.model));
  };
  if (!source.further_curves.empty()) refuse("a texture");
  if (source.relief) refuse("a relief");
  if (ScatteringAssembly::map_count(source) > 0) refuse("a map of a parameter");
}

/// How many constituents a material may make of one, as parts of a texture and levels of its parameters.
std::size_t parts_of(const io::MaterialDocument& source) {
  return (source.texture ? 2u : 1u) << ScatteringAssembly::map_count(source);
}

}  // namespace

AssignmentAssembly::AssignmentAssembly(const io::DocumentSources& sources,
                                       const std::vector<io::MaterialDocument>& materials, std::uint64_t seed,
                                       const MapFrame& frame, scene::Scene& scene, LogSink* log)
    : sources_(sources),
      written_(materials),
      scene_(scene),
      log_(log),
      textures_(sources, materials, seed, frame, log),
      scattering_(sources, textures_, log) {
  add_materials();
}

void AssignmentAssembly::add_materials() {
  std::vector<materials::Material> further;
  const auto first = static_cast<std::uint32_t>(written_.size());
  for (const io::MaterialDocument& source : written_) {
    materials::Material material;
    material.name = source.name;
    if (source.sides) {
      // Holds the place of the document's material; surfaces are of its sides.
      material.reflectance = radiometry::Spectrum::constant(0.0);
      material.curve_of = material_index(source.sides->first.name);
      first_further_.push_back(first + static_cast<std::uint32_t>(further.size()));
      behind_.push_back(static_cast<std::uint32_t>(scene_.materials.size()));
      scene_.materials.push_back(std::move(material));
      continue;
    }
    if (source.transmittance)
      material.transmittance =
          assemble_spectrum(sources_, *source.transmittance, format("transmittance of {}", source.name));
    if (source.temperature)
      if (const double* fixed_k = std::get_if<double>(&source.temperature->value))
        material.temperature_k = *fixed_k;
    const auto take = [&](const io::SpectrumDocument& curve, const std::string& what) {
      const radiometry::Spectrum spectrum =
          assemble_spectrum(sources_, curve, format("{}{}", what, source.name));
      material.reflectance = source.is_emissivity ? spectrum.complement() : spectrum;
      if (ScatteringAssembly::map_count(source) > 0)
        unscattered_[scene_.materials.size()].push_back(material);
      with_position(sources_, source.position, [&] { scattering_.assemble(source, material); });
    };
    take(source.spectrum, source.further_curves.empty() ? "" : "curve 1 of ");
    scene_.materials.push_back(material);
    const auto own = static_cast<std::uint32_t>(scene_.materials.size() - 1);
    first_further_.push_back(first + static_cast<std::uint32_t>(further.size()));
    material.curve_of = own;
    for (std::size_t k = 0; k < source.further_curves.size(); ++k) {
      take(source.further_curves[k], format("curve {} of ", k + 2));
      further.push_back(material);
    }
    behind_.push_back(own);
    if (const std::shared_ptr<const materials::Bsdf> behind = scene_.materials[own].bsdf->behind()) {
      with_position(sources_, source.position, [&] { check_two_sided(source); });
      materials::Material back = scene_.materials[own];
      back.bsdf = behind;
      back.reflectance = materials::directional_hemispherical(*behind, materials::Side::reflected,
                                                              materials::kBihemispherical);
      back.curve_of = own;
      behind_.back() = first + static_cast<std::uint32_t>(further.size());
      further.push_back(std::move(back));
    }
  }
  scene_.materials.insert(scene_.materials.end(), further.begin(), further.end());
  for (const io::MaterialDocument& source : written_)
    if (source.sides)
      with_position(sources_, source.sides->second.position,
                    [&] { check_sides(source.sides->first, source.sides->second); });
}

void AssignmentAssembly::check_sides(const io::DocumentName& front_name,
                                     const io::DocumentName& back_name) const {
  const std::uint32_t front = material_index(front_name.name), back = material_index(back_name.name);
  for (const std::uint32_t side : {front, back})
    if (behind_[side] != side)
      throw InputError(format(
          "'{}' is seen otherwise from behind itself ('{}') and cannot be a side: give it to objects alone",
          scene_.materials[side].name, written_[side].scattering.model));
  const auto lets_through = [&](std::uint32_t m, double um) {
    const auto& transmittance = scene_.materials[m].transmittance;
    return transmittance ? transmittance->at(um) : 0.0;
  };
  const bool through_front = scene_.materials[front].transmittance.has_value(),
             through_back = scene_.materials[back].transmittance.has_value();
  if (through_front != through_back)
    throw InputError(format(
        "light comes through '{}' and not through '{}': the sides of a sheet let through the same",
        through_front ? front_name.name : back_name.name, through_front ? back_name.name : front_name.name));
  if (!through_front) return;
  if (scene_.materials[front].bsdf->passage() != scene_.materials[back].bsdf->passage())
    throw InputError(format("light goes straight through one of '{}' and '{}' and is spread by the other",
                            front_name.name, back_name.name));
  constexpr double kSame = 1e-3;
  const radiometry::Spectrum* both[] = {&*scene_.materials[front].transmittance,
                                        &*scene_.materials[back].transmittance};
  std::vector<double> um = radiometry::common_wavelengths(both).um;
  if (um.empty()) um.push_back(1.0);
  for (const double at : um) {
    const double of_front = lets_through(front, at), of_back = lets_through(back, at);
    if (std::abs(of_front - of_back) > kSame)
      throw InputError(format(
          "'{}' lets through {:.4g}{} and '{}' {:.4g}: through a sheet as much goes one way as the other (reciprocity)",
          front_name.name, of_front, um.size() > 1 ? format(" at {:g} um", at) : "", back_name.name,
          of_back));
  }
}

std::uint32_t AssignmentAssembly::assignment(const io::MaterialBinding& binding, const std::string& slot_name,
                                             const std::optional<io::TemperatureDocument>& temperature) {
  scene::SurfaceAssignment assignment;
  std::vector<Surface> surfaces;
  std::visit(
      Overloaded{[&](const io::DocumentName& name) { surfaces.push_back(surface_of(name, temperature)); },
                 [&](const io::MaterialSlots& slots) {
                   const auto found = std::find_if(slots.slots.begin(), slots.slots.end(),
                                                   [&](const auto& slot) { return slot.first == slot_name; });
                   if (found == slots.slots.end()) {
                     std::string names;
                     for (const auto& slot : slots.slots)
                       names += (names.empty() ? "'" : ", '") + slot.first + "'";
                     throw io::document_error(
                         sources_, binding.position,
                         format("no material for slot '{}' of the mesh; the slots given are {}", slot_name,
                                names.empty() ? "none" : names));
                   }
                   surfaces.push_back(surface_of(found->second, temperature));
                 },
                 [&](const io::MaterialMap& map) {
                   with_position(sources_, binding.position, [&] { assignment.classes = class_map(map); });
                   for (const auto& entry : map.classes)
                     surfaces.push_back(surface_of(entry.second, temperature));
                 },
                 [&](const io::MixtureDocument& source) {
                   for (const io::DocumentName& material : source.materials)
                     surfaces.push_back(surface_of(material, temperature));
                   with_position(sources_, binding.position,
                                 [&] { assignment.patterns.push_back(mixture(source, surfaces)); });
                   assignment.states.push_back(surfaces[0].state);
                 }},
      binding.value);
  if (assignment.states.empty())
    for (const Surface& surface : surfaces) {
      assignment.states.push_back(surface.state);
      assignment.temperatures.push_back(surface.temperature);
    }
  with_position(sources_, binding.position, [&] {
    check_one_sided(binding, surfaces);
    check_room(binding, surfaces);
  });
  add_backs(assignment, surfaces);
  add_patterns(assignment, surfaces);
  return add(std::move(assignment));
}

void AssignmentAssembly::add_backs(scene::SurfaceAssignment& assignment,
                                   const std::vector<Surface>& surfaces) {
  const bool any = std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& surface) {
    return surface.back || behind_[surface.material] != surface.material;
  });
  if (!any || assignment.states.size() != surfaces.size()) return;
  bool mapped = false;
  for (const Surface& surface : surfaces) {
    const Surface back = seen_from_behind(surface);
    assignment.back_states.push_back(back.state);
    assignment.back_temperatures.push_back(back.temperature);
    mapped = mapped || back.temperature != surface.temperature;
  }
  if (!mapped) assignment.back_temperatures.clear();
}

AssignmentAssembly::Surface AssignmentAssembly::seen_from_behind(const Surface& surface) {
  if (surface.back) return *surface.back;
  Surface back = surface;
  back.material = behind_[surface.material];
  back.state = state({back.material, surface.fixed_k});
  return back;
}

void AssignmentAssembly::check_one_sided(const io::MaterialBinding& binding,
                                         const std::vector<Surface>& surfaces) const {
  if (!std::holds_alternative<io::MixtureDocument>(binding.value)) return;
  for (const Surface& surface : surfaces)
    if (surface.back || behind_[surface.material] != surface.material)
      throw InputError(format(
          "a mixture cannot hold '{}', which is seen otherwise from its inner side; a map of classes can",
          scene_.materials[surface.material].name));
}

bool AssignmentAssembly::refracts(std::uint32_t material) const {
  return scene_.materials[material].bsdf->passage() == materials::Passage::into;
}

std::vector<bool> AssignmentAssembly::mirrors() const { return scene_.mirror_assignments(); }
std::vector<bool> AssignmentAssembly::lobes() const { return scene_.lobe_assignments(); }

bool AssignmentAssembly::any_medium() const {
  for (std::uint32_t m = 0; m < scene_.materials.size(); ++m)
    if (refracts(m)) return true;
  return false;
}

void AssignmentAssembly::refuse_media(const io::MaterialBinding& binding) const {
  const auto check = [&](const io::DocumentName& name) {
    if (refracts(material_index(name.name)))
      throw io::document_error(
          sources_, binding.position,
          format(
              "light is refracted into '{}', but this shape has no inside: take a solid (a box, a sphere, a "
              "closed mesh) or a plane, {{\"slab\": ...}} for a pane, or \"over\": \"absorber\" where "
              "what enters it ends there",
              name.name));
  };
  std::visit(Overloaded{check,
                        [&](const io::MaterialSlots& slots) {
                          for (const auto& slot : slots.slots) check(slot.second);
                        },
                        [&](const io::MaterialMap& map) {
                          for (const auto& entry : map.classes) check(entry.second);
                        },
                        [&](const io::MixtureDocument& mixture) {
                          for (const io::DocumentName& name : mixture.materials) check(name);
                        }},
             binding.value);
}

std::uint32_t AssignmentAssembly::assignment(scene::SurfaceState surface) {
  scene::SurfaceAssignment assignment;
  assignment.states.push_back(state(surface));
  return add(std::move(assignment));
}

void AssignmentAssembly::add_patterns(scene::SurfaceAssignment& assignment,
                                      const std::vector<Surface>& fronts) {
  std::vector<Surface> surfaces = fronts;
  for (const Surface& surface : fronts)
    if (surface.back) surfaces.push_back(*surface.back);
  std::vector<Pattern> reliefs, textures, levels;
  const auto append = [](std::vector<Pattern>& list, const Pattern& pattern) {
    if (std::find(list.begin(), list.end(), pattern) == list.end()) list.push_back(pattern);
  };
  for (const Surface& surface : surfaces) {
    const io::MaterialDocument& source = written_[surface.material];
    if (source.relief) {
      Pattern& relief = patterns_[format("relief {}", surface.material)];
      if (!relief)
        relief = std::make_shared<scene::ReliefPattern>(textures_.relief(surface.material), surface.material);
      append(reliefs, relief);
    }
    if (source.texture) {
      Pattern& texture = patterns_[format("texture {}", surface.state)];
      if (!texture) {
        std::vector<radiometry::Spectrum> spectra;
        std::vector<scene::TexturePattern::Curve> curves;
        for (std::size_t c = 0; c <= source.further_curves.size(); ++c) {
          const std::uint32_t material =
              c == 0 ? surface.material
                     : first_further_[surface.material] + static_cast<std::uint32_t>(c - 1);
          spectra.push_back(scene_.materials[material].reflectance);
          curves.push_back({state({material, surface.fixed_k}), material});
        }
        texture = std::make_shared<scene::TexturePattern>(textures_.texture(surface.material, spectra),
                                                          surface.state, std::move(curves));
      }
      append(textures, texture);
    }
    for (const Pattern& pattern : level_patterns(surface)) append(levels, pattern);
  }
  // Relief goes by the document's material, which a texture replaces by the curve that it picks.
  assignment.patterns.insert(assignment.patterns.end(), reliefs.begin(), reliefs.end());
  assignment.patterns.insert(assignment.patterns.end(), textures.begin(), textures.end());
  assignment.patterns.insert(assignment.patterns.end(), levels.begin(), levels.end());
}

std::vector<AssignmentAssembly::Pattern> AssignmentAssembly::level_patterns(const Surface& surface) {
  std::vector<Pattern> patterns;
  const io::MaterialDocument& source = written_[surface.material];
  if (ScatteringAssembly::map_count(source) == 0) return patterns;
  const auto known = levels_.find(surface.material);
  Levels& levels = known != levels_.end() ? known->second : levels_[surface.material];
  if (levels.axes.empty()) {
    std::vector<materials::Material> curves = unscattered_.at(surface.material);
    for (materials::Material& curve : curves) curve.curve_of = surface.material;
    ScatteringAssembly::Levels made =
        with_position(sources_, source.position, [&] { return scattering_.levels(source, curves); });
    levels.axes = std::move(made.axes);
    for (std::vector<materials::Material>& members : made.members) {
      levels.first.push_back(static_cast<std::uint32_t>(scene_.materials.size()));
      std::move(members.begin(), members.end(), std::back_inserter(scene_.materials));
    }
  }
  std::size_t count = 1;
  for (const materials::ParameterAxis& axis : levels.axes) count *= axis.levels.size();
  for (std::size_t curve = 0; curve < levels.first.size(); ++curve) {
    const std::uint32_t material =
        curve == 0 ? surface.material
                   : first_further_[surface.material] + static_cast<std::uint32_t>(curve - 1);
    const std::uint32_t replaced = state({material, surface.fixed_k});
    Pattern& pattern = patterns_[format("levels {}", replaced)];
    if (!pattern) {
      std::vector<scene::LevelPattern::Member> members;
      for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t member = levels.first[curve] + static_cast<std::uint32_t>(k);
        members.push_back({state({member, surface.fixed_k}), member});
      }
      pattern =
          std::make_shared<scene::LevelPattern>(replaced, surface.state, levels.axes, std::move(members));
    }
    patterns.push_back(pattern);
  }
  return patterns;
}

void AssignmentAssembly::check_room(const io::MaterialBinding& binding,
                                    const std::vector<Surface>& surfaces) const {
  const bool mixture = std::holds_alternative<io::MixtureDocument>(binding.value);
  std::vector<std::size_t> parts;
  std::uint32_t mapped = 0;
  std::vector<Surface> all = surfaces;
  for (const Surface& surface : surfaces)
    if (surface.back) all.push_back(*surface.back);
  for (const Surface& surface : all) {
    const io::MaterialDocument& source = written_[surface.material];
    if (ScatteringAssembly::map_count(source) == 0 && !mixture) continue;
    parts.push_back(parts_of(source));
    if (ScatteringAssembly::map_count(source) > 0) mapped = surface.material + 1;
  }
  if (mapped == 0) return;
  std::sort(parts.rbegin(), parts.rend());
  if (parts.size() > scene::ResolvedSurface::kMost) parts.resize(scene::ResolvedSurface::kMost);
  const std::size_t most =
      mixture ? std::accumulate(parts.begin(), parts.end(), std::size_t{0}) : parts.front();
  if (most > scene::ResolvedSurface::kMost)
    throw InputError(format(
        "there is no room for '{}' with its maps of parameters: levels of these, curves of a texture and parts of a "
        "mixture stand side by side, {} of them at most, and here there may be {}",
        written_[mapped - 1].name, scene::ResolvedSurface::kMost, most));
}

std::shared_ptr<const materials::ClassMap> AssignmentAssembly::class_map(const io::MaterialMap& map) {
  std::string classes_text;
  for (const auto& entry : map.classes)
    classes_text += format("{}{}", classes_text.empty() ? "" : ", ", entry.first);
  std::shared_ptr<const materials::ClassMap>& shared = class_maps_[key_of(map.raster, classes_text)];
  if (shared) return shared;
  const io::Raster& raster = textures_.read(map.raster);
  std::vector<std::uint16_t> classes(static_cast<std::size_t>(raster.width) *
                                     static_cast<std::size_t>(raster.height));
  for (int row = 0; row < raster.height; ++row)
    for (int column = 0; column < raster.width; ++column) {
      const float value = raster.at(0, row, column);
      const auto found =
          std::lower_bound(map.classes.begin(), map.classes.end(), value, [](const auto& entry, float v) {
            return static_cast<double>(entry.first) < static_cast<double>(v);
          });
      if (found == map.classes.end() || static_cast<double>(found->first) != static_cast<double>(value))
        throw InputError(
            format("class {} at row {}, column {} of '{}' has no material; the classes given are {}", value,
                   row + 1, column + 1, map.raster.file.path, classes_text));
      classes[static_cast<std::size_t>(row) * static_cast<std::size_t>(raster.width) +
              static_cast<std::size_t>(column)] = static_cast<std::uint16_t>(found - map.classes.begin());
    }
  shared = std::make_shared<materials::ClassMap>(textures_.grid(map.raster, raster), std::move(classes));
  return shared;
}

AssignmentAssembly::Pattern AssignmentAssembly::mixture(const io::MixtureDocument& source,
                                                        const std::vector<Surface>& surfaces) {
  const std::string& path = source.raster.file.path;
  std::shared_ptr<const materials::MixtureMap>& map =
      mixture_maps_[key_of(source.raster, format("{}", surfaces.size()))];
  if (!map) {
    const io::Raster& raster = textures_.read(source.raster);
    if (static_cast<std::size_t>(raster.bands) != surfaces.size())
      throw InputError(
          format("'{}' has {} bands; 'materials' names {}", path, raster.bands, surfaces.size()));
    try {
      map = std::make_shared<materials::MixtureMap>(textures_.grid(source.raster, raster), surfaces.size(),
                                                    raster.values);
    } catch (const InputError& error) {
      throw InputError(format("'{}': {}", path, error.what()));
    }
    const materials::MixtureMap::Report& report = map->report();
    const std::string name = std::filesystem::path(path).filename().string();
    if (log_ != nullptr && report.rescaled > 0)
      log_->warn(format(
          "mixture '{}': the fractions of {} of {} cells sum to something else than 1 ({:.3g} to {:.3g}) "
          "and are rescaled",
          name, report.rescaled, map->grid().cell_count(), report.lowest_sum, report.highest_sum));
    if (log_ != nullptr && report.shortened > 0)
      log_->warn(format(
          "mixture '{}': {} of {} cells hold more than {} materials; the largest stay, and up to {:.3g} % "
          "of a cell goes to them",
          name, report.shortened, map->grid().cell_count(), materials::MixtureMap::kMost,
          100.0 * report.largest_loss));
  }
  std::string key = format("mixture {}", static_cast<const void*>(map.get()));
  std::vector<scene::MixturePattern::Part> parts;
  for (const Surface& surface : surfaces) {
    key += format("|{}|{}", surface.state, static_cast<const void*>(surface.temperature.get()));
    parts.push_back({surface.state, surface.material, surface.temperature});
  }
  Pattern& pattern = patterns_[key];
  if (!pattern) pattern = std::make_shared<scene::MixturePattern>(map, std::move(parts));
  return pattern;
}

AssignmentAssembly::Surface AssignmentAssembly::surface_of(
    const io::DocumentName& material, const std::optional<io::TemperatureDocument>& temperature) {
  const std::uint32_t index = material_index(material.name);
  const auto& sides = written_[index].sides;
  if (!sides) return plain_surface(index, temperature);
  Surface surface = plain_surface(material_index(sides->first.name), temperature);
  surface.back =
      std::make_shared<const Surface>(plain_surface(material_index(sides->second.name), temperature));
  return surface;
}

AssignmentAssembly::Surface AssignmentAssembly::plain_surface(
    std::uint32_t material, const std::optional<io::TemperatureDocument>& temperature) {
  Surface surface;
  surface.material = material;
  const std::optional<io::TemperatureDocument>& source =
      temperature ? temperature : written_[surface.material].temperature;
  if (source) {
    std::visit(Overloaded{[&](double fixed_k) { surface.fixed_k = fixed_k; },
                          [&](const io::TemperatureMap& map) {
                            with_position(sources_, source->position,
                                          [&] { surface.temperature = temperature_map(map); });
                          }},
               source->value);
  }
  surface.state = state({surface.material, surface.fixed_k});
  return surface;
}

std::shared_ptr<const materials::TemperatureMap> AssignmentAssembly::temperature_map(
    const io::TemperatureMap& map) {
  std::shared_ptr<const materials::TemperatureMap>& shared =
      temperature_maps_[key_of(map.raster, format("{}", map.offset_k))];
  if (shared) return shared;
  const io::Raster& raster = textures_.read(map.raster);
  const std::span<const float> numbers = band_of(raster, 1, map.raster.file.path);
  std::vector<float> temperature_k;
  std::size_t unknown = 0;
  for (const float number : numbers) {
    const bool missing =
        !std::isfinite(number) || (raster.nodata && number == static_cast<float>(*raster.nodata));
    unknown += missing;
    temperature_k.push_back(missing ? std::numeric_limits<float>::quiet_NaN()
                                    : number + static_cast<float>(map.offset_k));
  }
  const std::string& path = map.raster.file.path;
  if (unknown == numbers.size()) throw InputError(format("'{}': no cell has a temperature", path));
  if (unknown > 0) {
    io::fill_unknown(temperature_k, raster.width, raster.height, path);
    if (log_ != nullptr)
      log_->warn(format(
          "temperature map '{}': {} of {} cells hold no number and take the mean of their nearest neighbours",
          std::filesystem::path(path).filename().string(), unknown, numbers.size()));
  }
  try {
    shared = std::make_shared<materials::TemperatureMap>(textures_.grid(map.raster, raster),
                                                         std::move(temperature_k));
  } catch (const InputError& error) {
    throw InputError(format(
        "'{}': {}. If it stands for cells without a temperature, declare it as the file's nodata value "
        "(gdal_edit.py -a_nodata)",
        path, error.what()));
  }
  return shared;
}

std::uint32_t AssignmentAssembly::material_index(const std::string& name) const {
  for (std::size_t m = 0; m < written_.size(); ++m)
    if (written_[m].name == name) return static_cast<std::uint32_t>(m);
  throw InputError(format("there is no material '{}'", name));
}

std::uint32_t AssignmentAssembly::state(scene::SurfaceState wanted) {
  const auto found = std::find(scene_.states.begin(), scene_.states.end(), wanted);
  const auto index = static_cast<std::uint32_t>(found - scene_.states.begin());
  if (found == scene_.states.end()) scene_.states.push_back(wanted);
  return index;
}

std::uint32_t AssignmentAssembly::add(scene::SurfaceAssignment assignment) {
  const bool mapped = std::any_of(assignment.temperatures.begin(), assignment.temperatures.end(),
                                  [](const auto& map) { return map != nullptr; });
  if (!mapped) assignment.temperatures.clear();
  for (std::size_t k = 0; k < scene_.assignments.size(); ++k)
    if (scene_.assignments[k] == assignment) return static_cast<std::uint32_t>(k);
  scene_.assignments.push_back(std::move(assignment));
  return static_cast<std::uint32_t>(scene_.assignments.size() - 1);
}

}  // namespace ifov::session
