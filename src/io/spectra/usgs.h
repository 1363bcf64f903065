#pragma once

#include <filesystem>

#include "io/spectra/sample_spectrum.h"
#include "io/tables/text_table.h"

namespace ifov::io {

/// A spectrum of the USGS library. Version 6 (`.asc`, Clark et al. 2007, Data Series 231): lines of text,
/// then rows of wavelength (um), reflectance and standard deviation. Points marked as deleted (-1.23e34) are
/// left out. Throws InputError with file, line and column.
SampleSpectrum parse_usgs(const TextFile& file);

/// Version 7 (Kokaly et al. 2017, Data Series 1035): a title line, then one reflectance a line, whose
/// wavelengths (um) stand in a file of their own in the same way. A title that ends in TRAN means
/// transmittance.
SampleSpectrum parse_usgs(const TextFile& file, const TextFile& wavelengths);

SampleSpectrum read_usgs(const std::filesystem::path& path);
SampleSpectrum read_usgs(const std::filesystem::path& path, const std::filesystem::path& wavelengths);

}  // namespace ifov::io
