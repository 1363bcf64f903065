#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "io/spectra/csv_spectrum.h"
#include "radiometry/channel.h"

namespace ifov::io {

/// The channels of a sensor from text, in one of three shapes:
/// - blocks: a comment line (";" or "#") that says "BAND name" opens each channel; rows of wavelength and
/// response
///   follow (further columns are ignored);
/// - columns: a heading line, wavelengths in the first column, a response in each of the others under its
/// name (an
///   empty field: not given there);
/// - a list: headings "wavelength" and "fwhm"; each row is a Gaussian channel, named by its number.
/// Rows without band or heading are one channel named as the file. Without `unit`, wavelengths are
/// micrometres where the largest is below 100 and nanometres elsewhere. Throws InputError with file, line and
/// column.
std::vector<radiometry::Channel> read_channels(const std::filesystem::path& path,
                                               std::optional<WavelengthUnit> unit = {});
/// The same of text in memory.
std::vector<radiometry::Channel> parse_channels(const TextFile& file,
                                                std::optional<WavelengthUnit> unit = {});

}  // namespace ifov::io
