#pragma once

#include <filesystem>
#include <string>

#include "radiometry/spectrum.h"

namespace ifov::io {

/// One file of the ECOSTRESS or ASTER spectral library.
struct EcostressSpectrum {
  std::string name;         ///< "Name" of the header, UTF-8
  std::string type;         ///< "Type", "Class", as written
  std::string measurement;  ///< "Measurement": directional-hemispherical or the like
  radiometry::Spectrum reflectance;  ///< fraction, ascending wavelengths; transmittance files are refused
};

/// Reads a `.spectrum.txt` file: header of `Key: value` lines (long values may wrap), an empty line, two columns.
/// Percent or fractions, any order, Latin-1. The count and the range that the header states are checked. Throws
/// InputError with file, line and column.
EcostressSpectrum read_ecostress(const std::filesystem::path& path,
                                 radiometry::OutsideRange outside = radiometry::OutsideRange::error);

/// True if the file looks like one of that library (its first line starts with "Name:").
bool is_ecostress(const std::filesystem::path& path);

/// A visible-to-shortwave spectrum and a thermal one of the same sample, as one. In an overlap the thermal one counts
/// from its first wavelength on; a gap is bridged by a straight line.
radiometry::Spectrum join(const radiometry::Spectrum& vswir, const radiometry::Spectrum& tir);

}  // namespace ifov::io
