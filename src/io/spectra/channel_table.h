#pragma once

#include <filesystem>
#include <vector>

#include "io/spectra/csv_spectrum.h"
#include "radiometry/channel.h"

namespace ifov::io {

/// Spectral responses from text, in one of two shapes:
/// - blocks: comment lines (";", "#") of which one says "BAND name" open each band, followed by rows of wavelength and
///   response (further columns are ignored);
/// - columns: a heading line whose first field is the wavelength and whose others name the channels, then rows.
/// Wavelengths in `unit`; without it micrometres where the largest is below 100, else nanometres.
/// Throws InputError with file, line and column.
std::vector<radiometry::Channel> read_channels(const std::filesystem::path& path);
std::vector<radiometry::Channel> read_channels(const std::filesystem::path& path, WavelengthUnit unit);

}  // namespace ifov::io
