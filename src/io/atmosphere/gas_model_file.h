#pragma once

#include <filesystem>

#include "atmosphere/gas/gas_term_table.h"
#include "io/tables/text_table.h"

namespace ifov::io {

/// Terms of gases from a gas model file (docs/formats/gas_model.md), version 1. Throws InputError with the place where something is
/// missing, out of order or out of range, weights that do not sum to 1 (by how much) and other versions among them; SystemError
/// where the file cannot be read.
atmosphere::GasTermTable read_gas_model(const std::filesystem::path& path);
atmosphere::GasTermTable parse_gas_model(const TextFile& file);

/// The same as text. k is written to five digits.
std::string gas_model_text(const atmosphere::GasTermTable& table);

/// "H2O, CH4".
std::string gases_of(const atmosphere::GasTermTable& table);

}  // namespace ifov::io
