#pragma once

#include <string>

namespace ifov::landscape {

/// The entry of a material in a document, `"name": {...}`: spectra of the built-in library by name (or figures,
/// where it has none) and a temperature. An unknown name is a mistake of this program: std::logic_error.
std::string material_text(const std::string& name);

}  // namespace ifov::landscape
