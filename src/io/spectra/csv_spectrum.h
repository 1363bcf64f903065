#pragma once

#include <filesystem>
#include <string>

#include "io/tables/text_table.h"
#include "radiometry/spectrum.h"

namespace ifov::io {

enum class WavelengthUnit { micrometres, nanometres, wavenumber_per_cm };

/// "um", "nm", "cm-1"; anything else is an InputError that lists them.
WavelengthUnit parse_wavelength_unit(const std::string& name);

/// How to read two columns of a text table.
struct CsvSpectrumOptions {
  WavelengthUnit unit = WavelengthUnit::micrometres;
  int wavelength_column = 1;  ///< from 1
  int value_column = 2;       ///< from 1; used where value_name is empty
  std::string value_name;     ///< heading of the value column
  double scale = 1.0;         ///< values are multiplied by this (0.01 for percent)
  radiometry::OutsideRange outside = radiometry::OutsideRange::error;
};

/// A spectrum from a table in text: fields separated by commas, semicolons, tabs or blanks (found from the
/// file); empty lines and lines that start with #, ; or // are skipped, and so are heading lines before the
/// first number. Rows may ascend or descend. Throws InputError with file, line and column for anything else,
/// SystemError where the file cannot be read.
radiometry::Spectrum read_csv_spectrum(const std::filesystem::path& path,
                                       const CsvSpectrumOptions& options = {});
/// The same of text in memory.
radiometry::Spectrum parse_csv_spectrum(const TextFile& file, const CsvSpectrumOptions& options = {});

}  // namespace ifov::io
