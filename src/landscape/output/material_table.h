#pragma once

#include <string>

#include "landscape/output/scene_folder.h"

namespace ifov::landscape {

/// The entry of a material in a document, `"name": {...}`: spectra of the built-in library by name (or figures,
/// where it has none), a temperature, and a texture where the library has several curves; its map is written into
/// the folder. An unknown name is a mistake of this program: std::logic_error.
std::string material_text(const std::string& name, SceneFolder& folder);

}  // namespace ifov::landscape
