#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/run_control.h"
#include "materials/material.h"
#include "materials/parameter_map.h"

namespace ifov::io {
struct DocumentSources;
struct MaterialDocument;
struct ParameterMap;
}  // namespace ifov::io
namespace ifov::materials {
struct BsdfInputs;
struct BsdfModel;
struct BsdfParameter;
}  // namespace ifov::materials

namespace ifov::session {

class TextureAssembly;
struct ParameterValues;

/// Makes the scattering models of materials, and of those with parameters from maps the levels between which these lie. Keeps all
/// references; `log` may be null.
class ScatteringAssembly {
 public:
  ScatteringAssembly(const io::DocumentSources& sources, TextureAssembly& textures, LogSink* log);
  ~ScatteringAssembly();

  /// Gives its model to a material whose reflectance is known; a parameter from a map has the map's mean.
  void assemble(const io::MaterialDocument& source, materials::Material& material);

  /// How many of its parameters come from maps.
  static std::size_t map_count(const io::MaterialDocument& source);

  struct Levels {
    std::vector<materials::ParameterAxis> axes;
    std::vector<std::vector<materials::Material>> members;  ///< by curve, in the order of scene::LevelPattern
  };
  /// Of a material with such parameters; `curves` are its reflectances, in materials that assemble() has not seen yet. Says how many
  /// levels there are, and warns where what lies between them is off by more than materials::kLevelTolerance.
  Levels levels(const io::MaterialDocument& source, const std::vector<materials::Material>& curves);

 private:
  struct Mapped {
    const io::ParameterMap* map = nullptr;
    const materials::BsdfParameter* parameter = nullptr;
    const ParameterValues* values = nullptr;
  };
  using Numbers = std::vector<std::pair<std::string, double>>;

  /// Of all parameters but those from maps; `say`: let models tell what they changed.
  materials::BsdfInputs inputs_of(const io::MaterialDocument& source, const materials::Material& material,
                                  bool say) const;
  void finish(const io::MaterialDocument& source, const materials::BsdfInputs& inputs,
              materials::Material& material) const;
  std::vector<Mapped> mapped(const io::MaterialDocument& source);

  const io::DocumentSources& sources_;
  TextureAssembly& textures_;
  LogSink* log_;
  std::map<const io::ParameterMap*, std::unique_ptr<const ParameterValues>> values_;
};

}  // namespace ifov::session
