#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "io/atmosphere/modtran_tape7.h"

namespace ifov::io {

/// Runs of a table that MODTRAN 6 wrote (CSVPRNT, x.csv or x_scan.csv): a heading line for each case, of
/// which the first cell is the wavelength or wavenumber and the others are known by MODTRAN's names (of
/// tape7, of its JSON output or of its spectral libraries); perhaps a line of units below; rows. Other lines
/// above a heading are taken for names of cases. Numbers are W cm-2 sr-1 per unit of the spectral column.
/// Throws InputError with the place, also where no unit of the spectral column is stated and none is given.
std::vector<ModtranRun> read_modtran_csv(const std::filesystem::path& path,
                                         std::optional<WavelengthUnit> unit = std::nullopt);
std::vector<ModtranRun> parse_modtran_csv(const TextFile& file,
                                          std::optional<WavelengthUnit> unit = std::nullopt);

}  // namespace ifov::io
