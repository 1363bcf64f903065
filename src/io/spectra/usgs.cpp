#include "io/spectra/usgs.h"

#include "core/error.h"
#include "io/spectra/spectrum_rows.h"

namespace ifov::io {
namespace {

constexpr double kDeleted = -1e33;  // values below are -1.23e34

struct Value {
  int line;
  Field field;
  double value;
};

double number_at(const TextFile& file, int line, const Field& field) {
  const std::optional<double> value = number_in(field.text);
  if (!value) file.fail(line, field.column, format("found '{}'; expected a number", field.text));
  return *value;
}

std::string trimmed(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(line.substr(first, line.find_last_not_of(" \t") - first + 1));
}

/// One number a line below a title.
std::vector<Value> read_column(const TextFile& file) {
  if (file.line_count() == 0) file.fail(0, 0, "the file is empty; expected a title and a number a line");
  std::vector<Value> values;
  for (int number = 2; number <= file.line_count(); ++number) {
    const std::vector<Field> fields = split(file.line(number), ' ');
    if (fields.empty()) continue;
    if (fields.size() > 1)
      file.fail(number, fields[1].column,
                format("found {} words; expected one number a line", fields.size()));
    values.push_back({number, fields[0], number_at(file, number, fields[0])});
  }
  if (values.empty()) file.fail(0, 0, "found no number below the title");
  return values;
}

/// The line of the first row of three numbers, from 1; 0 where there is none.
int first_row(const TextFile& file) {
  for (int number = 1; number <= file.line_count(); ++number) {
    const std::vector<Field> fields = split(file.line(number), ' ');
    if (fields.size() == 3 && number_in(fields[0].text) && number_in(fields[1].text) &&
        number_in(fields[2].text))
      return number;
  }
  return 0;
}

SampleSpectrum finished(const TextFile& file, SpectrumRows& rows, const std::string& title) {
  if (rows.empty()) file.fail(0, 0, "every point is marked as deleted");
  const bool transmits = title.size() > 4 && title.substr(title.size() - 4) == "TRAN";
  return {title, transmits ? SampleQuantity::transmittance : SampleQuantity::reflectance,
          rows.spectrum(file, radiometry::OutsideRange::error, title)};
}

}  // namespace

SampleSpectrum parse_usgs(const TextFile& file) {
  const int first = first_row(file);
  if (first == 0)
    file.fail(0, 0,
              "found no row of wavelength, reflectance and standard deviation; a file of version 7 needs its "
              "file of "
              "wavelengths");
  SpectrumRows rows;
  for (int number = first; number <= file.line_count(); ++number) {
    const std::vector<Field> fields = split(file.line(number), ' ');
    if (fields.empty()) continue;
    if (fields.size() != 3)
      file.fail(
          number, 0,
          format("found {} columns; expected wavelength, reflectance and standard deviation", fields.size()));
    const double wavelength = number_at(file, number, fields[0]), value = number_at(file, number, fields[1]);
    number_at(file, number, fields[2]);
    if (value > kDeleted) rows.add(file, number, fields[0], wavelength, value, WavelengthUnit::micrometres);
  }
  // The title stands above a line of history, right over the rows.
  return finished(file, rows, first > 2 ? trimmed(file.line(first - 2)) : std::string("USGS spectrum"));
}

SampleSpectrum parse_usgs(const TextFile& file, const TextFile& wavelengths) {
  const std::vector<Value> values = read_column(file), at = read_column(wavelengths);
  if (values.size() != at.size())
    file.fail(0, 0,
              format("found {} values; the file of wavelengths '{}' has {}", values.size(),
                     wavelengths.name(), at.size()));
  SpectrumRows rows;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i].value > kDeleted)
      rows.add(wavelengths, at[i].line, at[i].field, at[i].value, values[i].value,
               WavelengthUnit::micrometres);
  if (rows.empty()) file.fail(0, 0, "every point is marked as deleted");
  return finished(wavelengths, rows, trimmed(file.line(1)));
}

SampleSpectrum read_usgs(const std::filesystem::path& path) { return parse_usgs(TextFile(path)); }

SampleSpectrum read_usgs(const std::filesystem::path& path, const std::filesystem::path& wavelengths) {
  return parse_usgs(TextFile(path), TextFile(wavelengths));
}

}  // namespace ifov::io
