#pragma once

#include <string>

#include "io/document/scene_document.h"
#include "landscape/output/scene_folder.h"

namespace ifov::landscape {

/// A material of a document: spectra of the built-in library by name (or figures,
/// where it has none), a temperature, and a texture where the library has several curves; its map is written into
/// the folder. An unknown name is a mistake of this program: std::logic_error.
io::MaterialDocument table_material(const std::string& name, SceneFolder& folder);

}  // namespace ifov::landscape
