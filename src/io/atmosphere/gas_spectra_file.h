#pragma once

#include <filesystem>

#include "atmosphere/gas/gas_spectra.h"
#include "io/tables/text_table.h"

namespace ifov::io {

/// Absorption cross sections of a gas from a table in text (docs/formats/gas_model.md#spectra): comments with #, a heading whose
/// first column is any word and the others are states ("1013.25 hPa 296 K"), every pressure with every temperature, then rows of a
/// wavenumber in cm-1, rising, and of one cross section in cm2 per molecule a state. The gas is not in the file. Throws InputError
/// with the place; SystemError where the file cannot be read.
atmosphere::GasSpectra read_gas_spectra(const std::filesystem::path& path);
atmosphere::GasSpectra parse_gas_spectra(const TextFile& file);

}  // namespace ifov::io
