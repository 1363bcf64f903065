#include "io/atmosphere/spectral_table.h"

#include <algorithm>
#include <cmath>

#include "io/spectra/spectrum_rows.h"

namespace ifov::io {
namespace {

constexpr double kLongest_um = 1e5, kShortest_um = 1e-2;

}  // namespace

std::optional<double> fortran_number(std::string_view text) {
  if (const auto plain = number_in(text)) return plain;
  std::string changed(text);
  for (char& symbol : changed)
    if (symbol == 'D' || symbol == 'd') symbol = 'E';
  if (changed.find_first_of("Ee") == std::string::npos) {
    const std::size_t sign = changed.find_last_of("+-");
    if (sign == std::string::npos || sign == 0 || changed.size() - sign != 4) return std::nullopt;
    changed = changed.substr(0, sign) + 'E' + changed.substr(sign);
  }
  // Numbers below the smallest double are nothing here.
  const std::size_t exponent = changed.find("E-");
  if (exponent != std::string::npos && changed.size() - exponent == 5) {
    const auto mantissa = number_in(std::string_view(changed).substr(0, exponent));
    const auto power = number_in(std::string_view(changed).substr(exponent + 2));
    if (mantissa && power && *power > 300.0) return 0.0;
  }
  return number_in(changed);
}

SpectralTable::SpectralTable(const TextFile& file, WavelengthUnit unit, std::vector<std::string> names)
    : file_(&file), unit_(unit), names_(std::move(names)), columns_(names_.size()), blank_(names_.size()) {}

void SpectralTable::add(int line, const Field& x, std::span<const Field> cells) {
  const std::optional<double> value = fortran_number(x.text);
  if (!value) file_->fail(line, x.column, format("found '{}'; expected a wavelength or wavenumber", x.text));
  check_order(line, x, *value);
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const Field cell = i < cells.size() ? cells[i] : Field{};
    if (x_.empty()) blank_[i] = cell.text.empty();
    if (cell.text.empty() != blank_[i])
      file_->fail(line, cell.column,
                  blank_[i] ? format("found '{}' under {}; expected nothing there, as in line {}", cell.text,
                                     names_[i], first_line_)
                            : format("found nothing under {}; expected a number, as in line {}", names_[i],
                                     first_line_));
    if (blank_[i]) continue;
    const std::optional<double> number = fortran_number(cell.text);
    if (!number)
      file_->fail(line, cell.column, format("found '{}' under {}; expected a number", cell.text, names_[i]));
    columns_[i].push_back(*number);
  }
  if (x_.empty()) first_line_ = line;
  x_.push_back(*value);
}

void SpectralTable::check_order(int line, const Field& x, double value) const {
  const double um = value > 0.0 ? to_um(value, unit_) : 0.0;
  if (!(um >= kShortest_um && um <= kLongest_um))
    file_->fail(line, x.column,
                format("found {:g}; expected a {} between {:g} and {:g} um", value,
                       unit_ == WavelengthUnit::wavenumber_per_cm ? "wavenumber (cm-1)"
                       : unit_ == WavelengthUnit::nanometres      ? "wavelength (nm)"
                                                                  : "wavelength (um)",
                       kShortest_um, kLongest_um));
  if (x_.empty()) return;
  if (value == x_.back()) file_->fail(line, x.column, format("found {:g} twice; expected each once", value));
  if (x_.size() > 1 && (value > x_.back()) != (x_[1] > x_[0]))
    file_->fail(
        line, x.column,
        format("found {:g} after {:g}; expected rows that ascend or descend throughout", value, x_.back()));
}

std::optional<std::size_t> SpectralTable::index(std::string_view name) const {
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (names_[i] == name && !blank_[i]) return i;
  return std::nullopt;
}

bool SpectralTable::has(std::string_view name) const { return !x_.empty() && index(name).has_value(); }

bool SpectralTable::falls_in_um() const { return x_.size() > 1 && to_um(x_[1], unit_) < to_um(x_[0], unit_); }

std::vector<double> SpectralTable::wavelength_um() const {
  std::vector<double> result;
  for (const double x : x_) result.push_back(to_um(x, unit_));
  if (falls_in_um()) std::reverse(result.begin(), result.end());
  return result;
}

std::vector<double> SpectralTable::column(std::string_view name) const {
  if (!has(name)) return {};
  std::vector<double> result = columns_[*index(name)];
  if (falls_in_um()) std::reverse(result.begin(), result.end());
  return result;
}

std::vector<double> SpectralTable::density(std::string_view name, double factor) const {
  std::vector<double> result = column(name);
  const std::vector<double> um = result.empty() ? std::vector<double>() : wavelength_um();
  for (std::size_t i = 0; i < result.size(); ++i) {
    // d(wavenumber) / d(wavelength) = 1e4 / um^2 with wavenumbers in cm-1.
    const double per_um = unit_ == WavelengthUnit::wavenumber_per_cm ? 1e4 / (um[i] * um[i])
                          : unit_ == WavelengthUnit::nanometres      ? 1e3
                                                                     : 1.0;
    result[i] *= factor * per_um;
  }
  return result;
}

}  // namespace ifov::io
