#pragma once

#include <filesystem>

#include "io/spectra/csv_spectrum.h"
#include "radiometry/spectrum.h"

namespace ifov::io {

/// A reflectance spectrum from a file of either kind: ECOSTRESS and ASTER files are known by their header, all else
/// is read as a table with `options` (of which only `outside` counts for the former). A file of the ECOSTRESS library
/// whose name holds ".vswir." is joined with its ".tir." partner where that lies beside it. Values outside 0 to 1
/// are an InputError.
radiometry::Spectrum read_reflectance(const std::filesystem::path& path, const CsvSpectrumOptions& options = {});

}  // namespace ifov::io
