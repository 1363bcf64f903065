#pragma once

#include <optional>
#include <string>

namespace ifov::io {
struct Document;
struct MaterialDocument;
}  // namespace ifov::io
namespace ifov::materials {
struct Material;
}

namespace ifov::session {

/// A document's material by its name. InputError, with the choices, where there is none of that name.
const io::MaterialDocument& find_material(const io::Document& document, const std::string& name);

/// What light.surroundings are named to be made of; none where nothing is named. InputError where there is no such material, or it is no
/// ground.
std::optional<materials::Material> surroundings_material(const io::Document& document);

/// It alone, without the rest of the scene; `curve`: of its reflectances, counted from 1. InputError where there is no such
/// curve, and of what the material names.
materials::Material assemble_material(const io::Document& document, const io::MaterialDocument& source,
                                      int curve);

}  // namespace ifov::session
