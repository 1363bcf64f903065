#pragma once

#include <filesystem>

#include "io/tables/text_table.h"
#include "materials/bsdf/bsdf_table.h"

namespace ifov::io {

/// An isotropic BRDF from a table in text with five columns: zenith angle of the light, of the view, azimuth between them (0:
/// the viewer has the light in the back; to 180), all in deg, wavelength in um, BRDF in 1/sr. Separators, comments and headings
/// as read_csv_spectrum() has them; rows in any order, every combination of the values once. Throws InputError with file, line
/// and column, or with the combination that is missing; SystemError where the file cannot be read.
materials::MeasuredBrdf read_brdf_table(const std::filesystem::path& path);
/// The same of text in memory.
materials::MeasuredBrdf parse_brdf_table(const TextFile& file);

}  // namespace ifov::io
