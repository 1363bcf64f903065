#pragma once

#include <filesystem>

#include "atmosphere/particles/phase_function_table.h"
#include "io/tables/text_table.h"

namespace ifov::io {

/// Phase functions from a table in text (docs/formats/phase_functions.md): comments with #, a heading whose first column is
/// any word and the others are wavelengths in um, then rows of a scattering angle in deg, from 0 to 180 and rising, and of one
/// value above 0 a wavelength. The integral of a function over the sphere is 4 pi, within 1 %. Throws InputError with the
/// place, for another integral with what it is; SystemError where the file cannot be read.
atmosphere::PhaseFunctionTable read_phase_functions(const std::filesystem::path& path);
atmosphere::PhaseFunctionTable parse_phase_functions(const TextFile& file);

}  // namespace ifov::io
