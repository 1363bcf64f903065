#pragma once

#include <filesystem>
#include <vector>

#include "io/tables/text_table.h"
#include "radiometry/spectrum.h"

namespace ifov::io {

/// A DIRSIG emissivity file: the number of curves, 91 weights for 0 to 90 degrees from the normal, then the
/// curves. In the old form each is a line with its number and 396 rows of wavenumber (39850 to 350 cm-1) and
/// emissivity; in the new one the word CURVE_BEGIN and rows of wavelength (um) and emissivity.
struct EmsFile {
  std::vector<double> weights;               ///< of the emissivity, by degree from the normal
  std::vector<radiometry::Spectrum> curves;  ///< emissivity
};

/// Throws InputError with file, line and column.
EmsFile parse_ems(const TextFile& file);
EmsFile read_ems(const std::filesystem::path& path);

}  // namespace ifov::io
