#include "io/spectra/channel_table.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "core/error.h"
#include "io/spectra/spectrum_rows.h"
#include "io/tables/text_table.h"

namespace ifov::io {
namespace {

/// One number of the table with its place.
struct Cell {
  int line;
  Field wavelength_field;
  double wavelength, value;
};

struct NamedCells {
  std::string name;
  std::vector<Cell> cells;
};

bool word_symbol(char symbol) {
  return std::isalnum(static_cast<unsigned char>(symbol)) != 0 || symbol == '_';
}

/// The word after "band" in a comment line; empty where there is none.
std::string band_name(std::string_view line) {
  const std::string lower = lower_case(line);
  for (std::size_t at = lower.find("band"); at != std::string::npos; at = lower.find("band", at + 1)) {
    const std::size_t end = at + 4;
    if ((at > 0 && word_symbol(lower[at - 1])) || end >= lower.size() ||
        (lower[end] != ' ' && lower[end] != '\t'))
      continue;
    const std::vector<Field> words = split(line.substr(end), ' ');
    if (!words.empty()) return std::string(words[0].text);
  }
  return {};
}

double number_at(const TextFile& file, int line, const Field& field) {
  const std::optional<double> value = number_in(field.text);
  if (!value) file.fail(line, field.column, format("found '{}'; expected a number", field.text));
  return *value;
}

/// Rows of wavelength and response under comment lines that name the band.
std::vector<NamedCells> read_blocks(const TextFile& file, const std::string& default_name) {
  std::vector<NamedCells> bands;
  std::string name = default_name;
  bool open = false;
  for (int number = 1; number <= file.line_count(); ++number) {
    const std::string_view line = file.line(number);
    if (is_blank(line)) continue;
    if (is_comment(line)) {
      const std::string found = band_name(line);
      if (!found.empty()) {
        name = found;
        open = false;
      }
      continue;
    }
    if (!open) bands.push_back({name, {}});
    open = true;
    std::vector<Field> fields = split(line, separator_of(line));
    std::erase_if(fields, [](const Field& field) { return field.text.empty(); });
    if (fields.size() < 2)
      file.fail(number, 0, format("found {} numbers; expected a wavelength and a response", fields.size()));
    bands.back().cells.push_back(
        {number, fields[0], number_at(file, number, fields[0]), number_at(file, number, fields[1])});
  }
  return bands;
}

/// A heading line and columns of numbers.
std::vector<NamedCells> read_columns(const TextFile& file, int heading_line) {
  const char separator = separator_of(file.line(heading_line));
  std::vector<NamedCells> bands;
  const std::vector<Field> heading = split(file.line(heading_line), separator);
  if (heading.size() < 2)
    file.fail(heading_line, 0, "found one heading; expected one for wavelength and one for each channel");
  for (std::size_t i = 1; i < heading.size(); ++i) bands.push_back({std::string(heading[i].text), {}});
  for (int number = heading_line + 1; number <= file.line_count(); ++number) {
    const std::string_view line = file.line(number);
    if (is_blank(line) || is_comment(line)) continue;
    const std::vector<Field> fields = split(line, separator);
    if (fields.size() != heading.size())
      file.fail(number, 0,
                format("found {} columns; expected {} as in the heading", fields.size(), heading.size()));
    const double wavelength = number_at(file, number, fields[0]);
    for (std::size_t i = 1; i < fields.size(); ++i)
      if (!fields[i].text.empty())
        bands[i - 1].cells.push_back({number, fields[0], wavelength, number_at(file, number, fields[i])});
  }
  return bands;
}

WavelengthUnit unit_of(const std::vector<NamedCells>& bands) {
  double largest = 0.0;
  for (const NamedCells& band : bands)
    for (const Cell& cell : band.cells) largest = std::max(largest, cell.wavelength);
  return largest < 100.0 ? WavelengthUnit::micrometres : WavelengthUnit::nanometres;
}

/// First line that is neither blank nor a comment, if it holds a heading.
int heading_line_of(const TextFile& file) {
  for (int number = 1; number <= file.line_count(); ++number) {
    const std::string_view line = file.line(number);
    if (is_blank(line) || is_comment(line)) continue;
    std::vector<Field> fields = split(line, separator_of(line));
    std::erase_if(fields, [](const Field& field) { return field.text.empty(); });
    return !fields.empty() && number_in(fields[0].text) ? 0 : number;
  }
  file.fail(0, 0, "found no row of numbers; expected wavelengths and responses");
}

/// Calls make() and puts the place of the row in front of what it finds wrong.
template <class Make>
radiometry::Channel located(const TextFile& file, int line, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    file.fail(line, 0, error.what());
  }
}

}  // namespace

std::vector<radiometry::Channel> read_channels(const std::filesystem::path& path,
                                               std::optional<WavelengthUnit> unit) {
  return parse_channels(TextFile(path), unit);
}

std::vector<radiometry::Channel> parse_channels(const TextFile& file, std::optional<WavelengthUnit> unit) {
  const int heading = heading_line_of(file);
  std::vector<NamedCells> bands = heading > 0
                                      ? read_columns(file, heading)
                                      : read_blocks(file, std::filesystem::path(file.name()).stem().string());
  const WavelengthUnit used = unit.value_or(unit_of(bands));
  std::vector<radiometry::Channel> channels;
  if (heading > 0 && bands.size() == 1 && lower_case(bands[0].name) == "fwhm") {
    if (used == WavelengthUnit::wavenumber_per_cm)
      file.fail(heading, 0, "a list of centres and widths is read in micrometres or nanometres");
    for (const Cell& cell : bands[0].cells)
      channels.push_back(located(file, cell.line, [&] {
        return radiometry::Channel::gaussian(format("{}", channels.size() + 1), to_um(cell.wavelength, used),
                                             to_um(cell.value, used));
      }));
  } else {
    for (NamedCells& band : bands) {
      if (band.cells.empty()) file.fail(heading, 0, format("the channel '{}' has no values", band.name));
      SpectrumRows rows;
      for (const Cell& cell : band.cells)
        rows.add(file, cell.line, cell.wavelength_field, cell.wavelength, cell.value, used);
      const radiometry::Spectrum response = rows.spectrum(file, radiometry::OutsideRange::zero, band.name);
      channels.push_back(located(file, band.cells.front().line,
                                 [&] { return radiometry::Channel::tabulated(band.name, response); }));
    }
  }
  if (channels.empty()) file.fail(0, 0, "found no row of numbers; expected wavelengths and responses");
  return channels;
}

}  // namespace ifov::io
