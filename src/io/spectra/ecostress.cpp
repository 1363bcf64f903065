#include "io/spectra/ecostress.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "io/spectra/spectrum_rows.h"
#include "io/tables/text_table.h"

namespace ifov::io {
namespace {

constexpr double kNoise = 0.02;

struct Header {
  struct Entry {
    std::string value;
    int line = 0;
  };
  std::map<std::string, Entry> entries;  // by key in lower case
  int last_line = 0;

  const Entry& need(const TextFile& file, const std::string& key) const {
    const auto found = entries.find(lower_case(key));
    if (found == entries.end()) file.fail(0, 0, format("the header has no '{}:' line", key));
    return found->second;
  }
};

std::string utf8_from_latin1(std::string_view text) {
  std::string result;
  for (const char symbol : text) {
    const unsigned char byte = static_cast<unsigned char>(symbol);
    if (byte < 0x80) {
      result += symbol;
    } else {
      result += static_cast<char>(0xc0 | (byte >> 6));
      result += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return result;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Whether a line of the header starts a new entry: a short key of letters before a colon. Wrapped text does
/// not.
std::size_t key_length(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || colon < 2 || colon > 30 || line[0] < 'A' || line[0] > 'Z') return 0;
  const bool words =
      std::all_of(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(colon), [](char symbol) {
        return (symbol >= 'a' && symbol <= 'z') || (symbol >= 'A' && symbol <= 'Z') || symbol == ' ' ||
               symbol == '.';
      });
  return words ? colon : 0;
}

bool is_data(std::string_view line) {
  const std::vector<Field> fields = split(line, ' ');
  return fields.size() == 2 && number_in(fields[0].text) && number_in(fields[1].text);
}

Header read_header(const TextFile& file) {
  Header header;
  Header::Entry* last = nullptr;
  for (int number = 1; number <= file.line_count() && !is_data(file.line(number)); ++number) {
    header.last_line = number;
    const std::string_view line = file.line(number);
    if (const std::size_t length = key_length(line)) {
      last = &header.entries[lower_case(line.substr(0, length))];
      *last = {utf8_from_latin1(trimmed(line.substr(length + 1))), number};
    } else if (last != nullptr && !is_blank(line)) {
      last->value += ' ' + utf8_from_latin1(trimmed(line));
    }
  }
  return header;
}

WavelengthUnit wavelength_unit(const TextFile& file, const Header::Entry& entry) {
  const std::string text = lower_case(entry.value);
  if (text.find("micrometer") != std::string::npos || text.find("micron") != std::string::npos)
    return WavelengthUnit::micrometres;
  if (text.find("nanometer") != std::string::npos) return WavelengthUnit::nanometres;
  if (text.find("wavenumber") != std::string::npos) return WavelengthUnit::wavenumber_per_cm;
  file.fail(entry.line, 0,
            "found an unknown unit of wavelength; expected micrometers, nanometers or wavenumbers");
}

double value_scale(const TextFile& file, const Header::Entry& entry) {
  const std::string text = lower_case(entry.value);
  if (text.find("transmi") != std::string::npos)
    file.fail(entry.line, 0, "found a transmittance; expected a reflectance");
  if (text.find("percent") != std::string::npos || text.find('%') != std::string::npos) return 0.01;
  if (text.find("fraction") != std::string::npos || text.find("unitless") != std::string::npos) return 1.0;
  file.fail(entry.line, 0, "found an unknown unit of reflectance; expected percent or a fraction");
}

void check_statements(const TextFile& file, const Header& header, const SpectrumRows& rows,
                      WavelengthUnit unit) {
  const Header::Entry& count = header.need(file, "Number of X Values");
  const std::optional<double> stated = number_in(count.value);
  if (!stated || *stated != static_cast<double>(rows.size()))
    file.fail(count.line, 0, format("the header states '{}' values; found {}", count.value, rows.size()));
  const char* keys[] = {"First X Value", "Last X Value"};
  const double found[] = {rows.first_um(), rows.last_um()};
  for (int i = 0; i < 2; ++i) {
    const Header::Entry& end = header.need(file, keys[i]);
    const std::optional<double> value = number_in(end.value);
    if (!value || !(*value > 0.0) || std::abs(to_um(*value, unit) / found[i] - 1.0) > 1e-3)
      file.fail(end.line, 0, format("the header states '{}'; found {:g} um", end.value, found[i]));
  }
}

}  // namespace

LibrarySpectrum read_ecostress(const std::filesystem::path& path, radiometry::OutsideRange outside) {
  return parse_ecostress(TextFile(path), outside);
}

LibrarySpectrum parse_ecostress(const TextFile& file, radiometry::OutsideRange outside) {
  const Header header = read_header(file);
  const WavelengthUnit unit = wavelength_unit(file, header.need(file, "X Units"));
  const double scale = value_scale(file, header.need(file, "Y Units"));
  SpectrumRows rows;
  for (int number = header.last_line + 1; number <= file.line_count(); ++number) {
    const std::vector<Field> fields = split(file.line(number), ' ');
    if (fields.empty()) continue;
    for (const Field& field : fields)
      if (!number_in(field.text))
        file.fail(number, field.column, format("found '{}'; expected a number", field.text));
    if (fields.size() != 2)
      file.fail(number, 0,
                format("found {} numbers; expected a wavelength and a reflectance", fields.size()));
    const double value = scale * *number_in(fields[1].text);
    if (value < -kNoise || value > 1.0 + kNoise)
      file.fail(number, fields[1].column, format("found a reflectance of {:g}; expected 0 to 1", value));
    rows.add(file, number, fields[0], *number_in(fields[0].text), std::clamp(value, 0.0, 1.0), unit);
  }
  if (rows.empty()) file.fail(0, 0, "found no row of numbers; expected wavelengths and reflectances");
  check_statements(file, header, rows, unit);
  const std::string& name = header.need(file, "Name").value;
  const auto measurement = header.entries.find("measurement");
  return {name, measurement == header.entries.end() ? std::string() : measurement->second.value,
          rows.spectrum(file, outside, std::filesystem::path(file.name()).filename().string())};
}

}  // namespace ifov::io
