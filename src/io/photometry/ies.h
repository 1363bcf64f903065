#pragma once

#include <filesystem>

#include "io/tables/text_table.h"
#include "radiometry/photometry.h"

namespace ifov::io {

/// A file of IES LM-63 (1986 to 2019), type C: intensities with the file's multiplier and ballast factors. How the lamp's
/// output changes as it is tilted is passed over. Throws InputError with file, line and column; SystemError where the
/// file cannot be read.
radiometry::LuminousIntensity read_ies(const std::filesystem::path& path);
/// The same of text in memory.
radiometry::LuminousIntensity parse_ies(const TextFile& file);

}  // namespace ifov::io
