#pragma once

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

/// It alone, without the rest of the scene; `curve`: of its reflectances, counted from 1. InputError where there is no such
/// curve, and of what the material names.
materials::Material assemble_material(const io::Document& document, const io::MaterialDocument& source,
                                      int curve);

}  // namespace ifov::session
