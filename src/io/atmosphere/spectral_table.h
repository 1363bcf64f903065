#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/spectra/csv_spectrum.h"
#include "io/tables/text_table.h"

namespace ifov::io {

/// A number as Fortran writes it: also with D for E, and without E before an exponent of three digits.
std::optional<double> fortran_number(std::string_view text);

/// Named columns over wavelength or wavenumber, read row by row. A column is either full or blank throughout.
class SpectralTable {
 public:
  /// `names` are those of the columns beside the spectral one, unique; `file` outlives the table.
  SpectralTable(const TextFile& file, WavelengthUnit unit, std::vector<std::string> names);

  /// A row: cells in the order of the names; an empty text is a blank. Throws InputError at what is no
  /// number, out of order, or blank (or not) unlike the first row.
  void add(int line, const Field& x, std::span<const Field> cells);

  std::size_t size() const { return x_.size(); }
  int first_line() const { return first_line_; }
  bool has(std::string_view name) const;
  WavelengthUnit unit() const { return unit_; }

  /// Rising.
  std::vector<double> wavelength_um() const;
  /// In the order of wavelength_um(); empty where there is none of that name or it is blank.
  std::vector<double> column(std::string_view name) const;
  /// The same times `factor`, where the numbers are per unit of the spectral column (cm-1, nm or um) and the
  /// result is per um.
  std::vector<double> density(std::string_view name, double factor) const;

  const TextFile& file() const { return *file_; }

 private:
  std::optional<std::size_t> index(std::string_view name) const;
  bool falls_in_um() const;
  void check_order(int line, const Field& x, double value) const;

  const TextFile* file_;
  WavelengthUnit unit_;
  std::vector<std::string> names_;
  std::vector<double> x_;
  std::vector<std::vector<double>> columns_;
  std::vector<bool> blank_;
  int first_line_ = 0;
};

}  // namespace ifov::io
