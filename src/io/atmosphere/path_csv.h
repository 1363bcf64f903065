#pragma once

#include <filesystem>

#include "atmosphere/imported_path.h"
#include "io/tables/text_table.h"

namespace ifov::io {

/// The project's own table of a path (docs/formats/atmosphere_import.md): comments with #, then headings, of
/// which the first is wavelength_um, wavelength_nm or wavenumber_cm-1 and the others are names of
/// atmosphere::PathQuantity, in the units of ImportedPath. Columns may be blank throughout. Throws InputError
/// with the place, for unknown names with the choices.
atmosphere::ImportedPath read_path_csv(const std::filesystem::path& path);
atmosphere::ImportedPath parse_path_csv(const TextFile& file);

/// The same table of a path, for other programs and for tests.
std::string path_csv(const atmosphere::ImportedPath& path);

}  // namespace ifov::io
