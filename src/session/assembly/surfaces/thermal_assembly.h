#pragma once

#include <optional>
#include <string>
#include <vector>

#include "thermal/solid.h"
#include "thermal/surface_balance.h"
#include "thermal/surface_solution.h"

namespace ifov::io {
struct DocumentSources;
struct MaterialDocument;
}  // namespace ifov::io
namespace ifov::materials {
struct Material;
}

namespace ifov::session {

/// What a surface's temperature is solved from.
struct ThermalMaterial {
  thermal::Solid solid;
  thermal::Skin skin;
  thermal::Start start = thermal::Start::steady;
  std::vector<std::string> description;  ///< a line each
};

/// Of a material with `thermal`, or with a spectrum of the library, which knows what such surfaces stand on; nothing for one
/// that has neither. `optics`: the same material, assembled. `deep_k`: of ground whose temperature the document does not
/// tell. InputError, at the place in the document, where its spectrum does not say what it takes of sunlight or gives off.
std::optional<ThermalMaterial> assemble_thermal(const io::DocumentSources& sources,
                                                const io::MaterialDocument& source,
                                                const materials::Material& optics, double deep_k);

}  // namespace ifov::session
