#include "session/assembly/surfaces/scattering_assembly.h"

#include <algorithm>

#include "core/error.h"
#include "core/overloaded.h"
#include "core/parallel.h"
#include "io/document/parameter_map_document.h"
#include "io/document/scene_document.h"
#include "io/spectra/brdf_table.h"
#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/parameter_levels.h"
#include "session/assembly/shared/spectrum_assembly.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/surfaces/parameter_values.h"
#include "session/assembly/surfaces/texture_assembly.h"

namespace ifov::session {
namespace {

constexpr std::size_t kMostMaps = 2;        // of one material: four levels side by side
constexpr std::size_t kMostLevels = 64;     // of the parameter of a material with one map
constexpr std::size_t kMostOfTwo = 16;      // of each of two
constexpr std::size_t kMostMembers = 2048;  // levels times curves

/// Whether a spectrum keeps to what its parameter may be, in all wavelengths.
void check_range(const io::DocumentSources& sources, const io::SpectrumDocument& source,
                 const radiometry::Spectrum& spectrum, const materials::BsdfParameter& parameter) {
  const double low = spectrum.minimum(), high = spectrum.maximum();
  if (low >= parameter.low && high <= parameter.high) return;
  const bool is_low = low < parameter.low;
  const double limit = is_low ? parameter.low : parameter.high, value = is_low ? low : high;
  with_position(sources, source.position, [&] {
    throw InputError(format("'{}' is {:g}{}, {} {:g}: it lies between {:g} and {:g}", parameter.key, value,
                            spectrum.is_constant() ? "" : " at some wavelength", is_low ? "below" : "above",
                            limit, parameter.low, parameter.high));
  });
}

const materials::BsdfParameter& parameter_of(const materials::BsdfModel& model, const std::string& key) {
  return *std::find_if(model.parameters.begin(), model.parameters.end(),
                       [&](const materials::BsdfParameter& p) { return p.key == key; });
}

}  // namespace

ScatteringAssembly::ScatteringAssembly(const io::DocumentSources& sources, TextureAssembly& textures,
                                       LogSink* log)
    : sources_(sources), textures_(textures), log_(log) {}

ScatteringAssembly::~ScatteringAssembly() = default;

materials::BsdfInputs ScatteringAssembly::inputs_of(const io::MaterialDocument& source,
                                                    const materials::Material& material, bool say) const {
  const materials::BsdfModel& model = materials::bsdf_model(source.scattering.model);
  materials::BsdfInputs inputs{material.reflectance, {}, {}};
  if (say && log_ != nullptr)
    inputs.say = [this, name = source.name](const std::string& change) {
      log_->warn(format("material '{}': {}", name, change));
    };
  for (const auto& entry : source.scattering.values) {
    const std::string& key = entry.first;
    std::visit(Overloaded{[&](double number) { inputs.values.emplace_back(key, number); },
                          [&](const std::shared_ptr<const io::ParameterMap>&) {},
                          [&](const std::string& word) { inputs.values.emplace_back(key, word); },
                          [&](const io::SpectrumDocument& spectrum) {
                            const radiometry::Spectrum values =
                                assemble_spectrum(sources_, spectrum, format("{} of {}", key, source.name));
                            check_range(sources_, spectrum, values, parameter_of(model, key));
                            inputs.values.emplace_back(key, values);
                          },
                          [&](const io::DocumentFile& file) {
                            with_position(sources_, file.position, [&] {
                              inputs.values.emplace_back(key, io::read_brdf_table(file.path));
                            });
                          },
                          [&](bool flag) { inputs.values.emplace_back(key, flag ? 1.0 : 0.0); }},
               entry.second);
  }
  return inputs;
}

void ScatteringAssembly::finish(const io::MaterialDocument& source, const materials::BsdfInputs& inputs,
                                materials::Material& material) const {
  material.bsdf = materials::bsdf_model(source.scattering.model).make(inputs);
  const bool directional = !material.bsdf->is_separable(),
             transmits = directional && material.bsdf->may_transmit();
  if (transmits && source.transmittance)
    throw InputError(format("material '{}': '{}' says itself what it transmits; leave 'transmittance' out",
                            source.name, source.scattering.model));
  if (transmits) material.transmittance.reset();
  materials::check(material);
  const auto whole = [&](materials::Side side) {
    return materials::directional_hemispherical(*material.bsdf, side, materials::kBihemispherical);
  };
  if (directional) material.reflectance = whole(materials::Side::reflected);
  if (transmits) material.transmittance = whole(materials::Side::transmitted);
}

std::size_t ScatteringAssembly::map_count(const io::MaterialDocument& source) {
  return static_cast<std::size_t>(
      std::count_if(source.scattering.values.begin(), source.scattering.values.end(), [](const auto& value) {
        return std::holds_alternative<std::shared_ptr<const io::ParameterMap>>(value.second);
      }));
}

std::vector<ScatteringAssembly::Mapped> ScatteringAssembly::mapped(const io::MaterialDocument& source) {
  const materials::BsdfModel& model = materials::bsdf_model(source.scattering.model);
  std::vector<Mapped> all;
  for (const auto& entry : source.scattering.values) {
    const std::string& key = entry.first;
    const auto* shared = std::get_if<std::shared_ptr<const io::ParameterMap>>(&entry.second);
    if (shared == nullptr) continue;
    const io::ParameterMap* map = shared->get();
    const materials::BsdfParameter& parameter = parameter_of(model, key);
    with_position(sources_, map->raster.file.position, [&] {
      if (all.size() == kMostMaps)
        throw InputError(
            format("'{}' is one map too many: of the parameters of a material {} may come from maps", key,
                   kMostMaps));
      std::unique_ptr<const ParameterValues>& values = values_[map];
      if (!values)
        values = std::make_unique<const ParameterValues>(
            parameter_values(*map, textures_.read(map->raster), parameter));
      all.push_back({map, &parameter, values.get()});
    });
  }
  return all;
}

void ScatteringAssembly::assemble(const io::MaterialDocument& source, materials::Material& material) {
  materials::BsdfInputs inputs = inputs_of(source, material, true);
  for (const Mapped& one : mapped(source))
    inputs.values.emplace_back(std::string(one.parameter->key), one.values->mean);
  finish(source, inputs, material);
}

ScatteringAssembly::Levels ScatteringAssembly::levels(const io::MaterialDocument& source,
                                                      const std::vector<materials::Material>& curves) {
  const std::vector<Mapped> maps = mapped(source);
  std::vector<materials::BsdfInputs> inputs;
  for (const materials::Material& curve : curves) inputs.push_back(inputs_of(source, curve, false));
  const auto at_level = [&](std::size_t curve, const Numbers& numbers, const auto& action) {
    materials::BsdfInputs of_level = inputs[curve];
    for (const auto& number : numbers) of_level.values.push_back(number);
    try {
      return action(of_level);
    } catch (const InputError& error) {
      std::string where;
      for (const auto& [key, number] : numbers)
        where += format("{}'{}' is {:g}", where.empty() ? "" : " and ", key, number);
      throw InputError(format("{} (where {})", error.what(), where));
    }
  };
  const auto model_at = [&](std::size_t curve, const Numbers& numbers) {
    return at_level(curve, numbers, [&](const materials::BsdfInputs& of_level) {
      return materials::bsdf_model(source.scattering.model).make(of_level);
    });
  };
  const auto material_at = [&](std::size_t curve, const Numbers& numbers) {
    return at_level(curve, numbers, [&](const materials::BsdfInputs& of_level) {
      materials::Material material = curves[curve];
      finish(source, of_level, material);
      return material;
    });
  };

  Levels levels;
  std::size_t members = curves.size();
  for (std::size_t a = 0; a < maps.size(); ++a) {
    const std::string key(maps[a].parameter->key);
    const auto models = [&](double value) {
      std::vector<std::shared_ptr<const materials::Bsdf>> made;
      for (const std::size_t curve : {std::size_t{0}, curves.size() - 1}) {
        if (maps.size() == 1) {
          made.push_back(model_at(curve, {{key, value}}));
        } else {
          const Mapped& other = maps[1 - a];
          for (const double end : {other.values->distinct.front(), other.values->distinct.back()})
            made.push_back(model_at(curve, {{key, value}, {std::string(other.parameter->key), end}}));
        }
        if (curves.size() == 1) break;
      }
      return made;
    };
    with_position(sources_, maps[a].map->raster.file.position, [&] {
      const std::vector<double>& distinct = maps[a].values->distinct;
      const materials::ParameterLevels placed =
          materials::place_levels(distinct, maps.size() == 1 ? kMostLevels : kMostOfTwo, models);
      members *= placed.values.size();
      if (members > kMostMembers)
        throw InputError(format("'{}' of material '{}': {} curves and levels of parameters are more than {}",
                                key, source.name, members, kMostMembers));
      const bool rough = placed.worst.reflectance > materials::kLevelTolerance.reflectance ||
                         placed.worst.direction > materials::kLevelTolerance.direction;
      const std::string text = format(
          "material '{}': '{}' by a map, {} levels; between them reflectance is off by up to {:.2g} % of itself, and {:.2g} % of "
          "the light leaves in another direction",
          source.name, key, placed.values.size(), 100.0 * placed.worst.reflectance,
          100.0 * placed.worst.direction);
      if (placed.worst.reflectance > materials::kLevelLimit.reflectance ||
          placed.worst.direction > materials::kLevelLimit.direction)
        throw InputError(format("{}: more than {:g} %; give the map a narrower range or fewer values", text,
                                100.0 * materials::kLevelLimit.reflectance));
      if (log_ != nullptr && rough)
        log_->warn(text);
      else if (log_ != nullptr)
        log_->info(text);
      const io::Raster& raster = textures_.read(maps[a].map->raster);
      levels.axes.push_back({std::make_shared<materials::ParameterMap>(
                                 textures_.grid(maps[a].map->raster, raster), maps[a].values->by_cell),
                             placed.values});
    });
  }
  const std::size_t inner = maps.size() == 1 ? 1 : levels.axes[1].levels.size();
  for (std::size_t curve = 0; curve < curves.size(); ++curve) {
    std::vector<materials::Material>& of_curve = levels.members.emplace_back();
    of_curve.resize(levels.axes[0].levels.size() * inner);
    parallel_for(static_cast<std::int64_t>(of_curve.size()), 0, [&](std::int64_t index) {
      const auto k = static_cast<std::size_t>(index);
      Numbers numbers{{std::string(maps[0].parameter->key), levels.axes[0].levels[k / inner]}};
      if (maps.size() > 1)
        numbers.emplace_back(std::string(maps[1].parameter->key), levels.axes[1].levels[k % inner]);
      of_curve[k] = material_at(curve, numbers);
    });
  }
  return levels;
}

}  // namespace ifov::session
