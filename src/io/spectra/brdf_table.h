#pragma once

#include <filesystem>

#include "io/tables/text_table.h"
#include "materials/bsdf/bsdf_table.h"

namespace ifov::io {

/// A BRDF or BTDF from a table in text. Isotropic with five columns: zenith angle of the light, of the view, azimuth between them (0:
/// the viewer has the light in the back; to 180), all in deg, wavelength in um, BRDF in 1/sr. With six: zenith angle and azimuth of the
/// light, both of the view, wavelength and BRDF. Separators, comments and headings
/// as read_csv_spectrum() has them; rows in any order, every combination of the values once. Throws InputError with file, line
/// and column, or with the combination that is missing; SystemError where the file cannot be read.
materials::MeasuredBrdf read_brdf_table(const std::filesystem::path& path);
/// The same of text in memory.
materials::MeasuredBrdf parse_brdf_table(const TextFile& file);

}  // namespace ifov::io
