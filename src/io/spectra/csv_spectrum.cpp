#include "io/spectra/csv_spectrum.h"

#include "core/error.h"
#include "io/files/inputs.h"
#include "io/spectra/spectrum_rows.h"
#include "io/tables/text_table.h"

namespace ifov::io {
namespace {

std::string listed(const std::vector<Field>& fields) {
  std::string list;
  for (const Field& field : fields) list += format("{}'{}'", list.empty() ? "" : ", ", field.text);
  return list;
}

/// Index of the column with a heading, from the last heading line above the numbers.
std::size_t column_named(const TextFile& file, int heading_line, const std::vector<Field>& heading,
                         const std::string& name) {
  for (std::size_t i = 0; i < heading.size(); ++i)
    if (heading[i].text == name) return i;
  if (heading_line == 0) file.fail(0, 0, format("no heading line to find the column '{}' in", name));
  file.fail(heading_line, 0, format("no column is called '{}'; there are {}", name, listed(heading)));
}

/// Columns in memory, as rows of a text would be taken.
radiometry::Spectrum spectrum_asset(const SpectrumColumns& columns, const std::filesystem::path& path,
                                    const CsvSpectrumOptions& options) {
  if (options.wavelength_column != 1 || options.value_column != 2 || !options.value_name.empty())
    throw InputError(format("'{}' is a spectrum in memory: its values are column 2", path.string()));
  const TextFile rows_of(path.string(), "");
  SpectrumRows rows;
  for (std::size_t k = 0; k < columns.wavelength.size(); ++k)
    rows.add(rows_of, static_cast<int>(k) + 1, {}, columns.wavelength[k], options.scale * columns.value[k],
             options.unit);
  return rows.spectrum(rows_of, options.outside, path.string());
}

}  // namespace

WavelengthUnit parse_wavelength_unit(const std::string& name) {
  if (name == "um") return WavelengthUnit::micrometres;
  if (name == "nm") return WavelengthUnit::nanometres;
  if (name == "cm-1") return WavelengthUnit::wavenumber_per_cm;
  throw InputError(format("found the unit '{}'; expected 'um', 'nm' or 'cm-1'", name));
}

/// "0,4"
bool has_decimal_comma(std::string_view text) {
  const std::size_t comma = text.find(',');
  return comma > 0 && comma + 1 < text.size() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c == ',' || (c >= '0' && c <= '9'); }) &&
         text.find(',', comma + 1) == std::string_view::npos;
}

radiometry::Spectrum read_csv_spectrum(const std::filesystem::path& path, const CsvSpectrumOptions& options) {
  if (const auto* const columns = arrays_of_asset<SpectrumColumns>(path, "a spectrum"))
    return spectrum_asset(*columns, path, options);
  return parse_csv_spectrum(TextFile(path), options);
}

radiometry::Spectrum parse_csv_spectrum(const TextFile& file, const CsvSpectrumOptions& options) {
  if (options.wavelength_column < 1 || options.value_column < 1)
    throw InputError(format("{}: columns count from 1", file.name()));
  const std::size_t x = static_cast<std::size_t>(options.wavelength_column - 1);
  std::size_t y = static_cast<std::size_t>(options.value_column - 1);
  std::vector<Field> heading;
  int heading_line = 0;
  char separator = '\0';
  SpectrumRows rows;
  for (int number = 1; number <= file.line_count(); ++number) {
    const std::string_view line = file.line(number);
    if (is_blank(line) || is_comment(line)) continue;
    if (separator == '\0') separator = separator_of(line);
    std::vector<Field> fields = split(line, separator);
    const std::optional<double> wavelength = x < fields.size() ? number_in(fields[x].text) : std::nullopt;
    if (rows.empty() && !wavelength && x < fields.size() && has_decimal_comma(fields[x].text))
      file.fail(number, fields[x].column,
                format("found '{}'; expected a number whose decimals follow a point", fields[x].text));
    if (rows.empty() && !wavelength) {
      heading = std::move(fields);
      heading_line = number;
      separator = '\0';  // headings may be prose
      continue;
    }
    if (rows.empty() && !options.value_name.empty())
      y = column_named(file, heading_line, heading, options.value_name);
    if (x >= fields.size() || y >= fields.size())
      file.fail(number, 0,
                format("found {} columns; column {} is wanted", fields.size(), std::max(x, y) + 1));
    const std::optional<double> value = number_in(fields[y].text);
    if (!wavelength || !value) {
      const Field& bad = wavelength ? fields[y] : fields[x];
      file.fail(number, bad.column, format("found '{}'; expected a number", bad.text));
    }
    rows.add(file, number, fields[x], *wavelength, options.scale * *value, options.unit);
  }
  if (rows.empty()) file.fail(0, 0, "found no row of numbers; expected wavelengths and values");
  return rows.spectrum(file, options.outside, std::filesystem::path(file.name()).filename().string());
}

}  // namespace ifov::io
