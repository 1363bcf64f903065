#pragma once

#include <filesystem>
#include <string>

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

/// A visible-to-shortwave spectrum and a thermal one of the same sample, as one. In an overlap the thermal
/// one counts from its first wavelength on; a gap is bridged by a straight line. Throws InputError where
/// either is a constant or the second does not reach beyond the first.
radiometry::Spectrum join(const radiometry::Spectrum& vswir, const radiometry::Spectrum& tir);

}  // namespace ifov::io
