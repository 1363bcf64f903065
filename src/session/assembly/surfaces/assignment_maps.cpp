// What maps put in the place of surfaces: classes, mixtures, temperatures, textures, reliefs and levels of parameters.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "io/raster/fill_unknown.h"
#include "scene/level_pattern.h"
#include "scene/map_patterns.h"
#include "scene/scene.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/surfaces/assignment_assembly.h"

namespace ifov::session {
namespace {

/// How many constituents a material may make of one, as parts of a texture and levels of its parameters.
std::size_t parts_of(const io::MaterialDocument& source) {
  return (source.texture ? 2u : 1u) << ScatteringAssembly::map_count(source);
}

}  // namespace

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
          curves.push_back({state(surface, material), material});
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
    const std::uint32_t replaced = state(surface, material);
    Pattern& pattern = patterns_[format("levels {}", replaced)];
    if (!pattern) {
      std::vector<scene::LevelPattern::Member> members;
      for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t member = levels.first[curve] + static_cast<std::uint32_t>(k);
        members.push_back({state(surface, member), member});
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

}  // namespace ifov::session
