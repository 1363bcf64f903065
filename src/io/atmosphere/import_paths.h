#pragma once

#include <filesystem>
#include <vector>

#include "atmosphere/imported_path.h"
#include "io/spectra/csv_spectrum.h"

namespace ifov::io {

/// What cannot be told from a file of paths itself.
struct ImportOptions {
  /// For the output of uvspec; empty: the file beside it of the same name that ends with .inp, .INP or .in.
  std::filesystem::path uvspec_input;
  std::optional<WavelengthUnit> unit;    ///< of the spectral column, where the file does not say or is wrong
  std::optional<double> sun_zenith_rad;  ///< for channel files, which do not say
};

/// Paths of a file of any format (docs/formats/atmosphere_import.md), told from its content: MODTRAN tape7,
/// channels and tables, output of uvspec, the project's own table. Throws InputError where it is none of
/// these or is malformed, SystemError where it cannot be read.
std::vector<atmosphere::ImportedPath> import_paths(const std::filesystem::path& path,
                                                   const ImportOptions& options = {});

}  // namespace ifov::io
