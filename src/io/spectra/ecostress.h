#pragma once

#include <filesystem>
#include <string>

#include "io/spectra/sample_spectrum.h"
#include "io/tables/text_table.h"
#include "radiometry/spectrum.h"

namespace ifov::io {

/// One file of the ECOSTRESS or ASTER spectral library.
struct LibrarySpectrum {
  std::string name;                  ///< "Name" of the header, in UTF-8
  std::string measurement;           ///< "Measurement": directional-hemispherical or the like
  radiometry::Spectrum reflectance;  ///< fraction
};

/// Reads a `.spectrum.txt` file: a header of `Key: value` lines (long values may wrap), then two columns.
/// Micrometres or wavenumbers, percent or fractions, any order, Latin-1. Values up to 0.02 below 0 or above 1
/// are noise of the measurement and count as 0 or 1. The count and the range that the header states are
/// checked. Throws InputError with file, line and column; a transmittance is refused.
LibrarySpectrum read_ecostress(const std::filesystem::path& path,
                               radiometry::OutsideRange outside = radiometry::OutsideRange::error);

/// The same of text in memory.
LibrarySpectrum parse_ecostress(const TextFile& file,
                                radiometry::OutsideRange outside = radiometry::OutsideRange::error);

}  // namespace ifov::io
