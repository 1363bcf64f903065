#include "io/document/cameras/jitter_table.h"

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/names.h"
#include "io/tables/text_table.h"

namespace ifov::io {
namespace {

constexpr std::array<std::string_view, 4> kSpectrumColumns{"frequency_hz", "yaw_rad2_hz", "pitch_rad2_hz",
                                                           "roll_rad2_hz"};

/// For each field of the heading, which of the names it is.
std::vector<std::size_t> read_spectrum_heading(const TextFile& file, int line) {
  const std::vector<std::string> choices(kSpectrumColumns.begin(), kSpectrumColumns.end());
  std::vector<std::size_t> columns;
  std::array<bool, kSpectrumColumns.size()> there{};
  for (const Field& field : split(file.line(line), ',')) {
    std::size_t k = 0;
    while (k < kSpectrumColumns.size() && kSpectrumColumns[k] != field.text) ++k;
    if (k == kSpectrumColumns.size())
      file.fail(line, field.column,
                format("found the heading '{}'; expected {}{}", field.text, list_names(choices),
                       did_you_mean(field.text, choices)));
    if (there[k]) file.fail(line, field.column, format("'{}' is there twice", field.text));
    there[k] = true;
    columns.push_back(k);
  }
  if (!there[0]) file.fail(line, 0, format("the table has no column '{}'", kSpectrumColumns[0]));
  if (columns.size() == 1)
    file.fail(
        line, 0,
        "the table has no column of a power: expected 'yaw_rad2_hz', 'pitch_rad2_hz' or 'roll_rad2_hz'");
  return columns;
}

}  // namespace

JitterSpectra read_jitter_table(const std::filesystem::path& path) {
  const TextFile file(path);
  std::vector<std::size_t> columns;
  std::array<std::vector<double>, kSpectrumColumns.size()> values;
  for (int line = 1; line <= file.line_count(); ++line) {
    if (is_blank(file.line(line)) || is_comment(file.line(line))) continue;
    if (columns.empty()) {
      columns = read_spectrum_heading(file, line);
      continue;
    }
    const std::vector<Field> fields = row_of(file, line, columns.size());
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const std::string_view name = kSpectrumColumns[columns[k]];
      std::vector<double>& column = values[columns[k]];
      const double highest = columns[k] == 0 ? 1e5 : 1.0;
      const double value = number_of(file, line, fields[k], {name, 0.0, highest});
      if (columns[k] == 0 && !column.empty() && !(value > column.back()))
        file.fail(line, fields[k].column,
                  format("found the frequency {:g} Hz after {:g} Hz; expected frequencies that increase",
                         value, column.back()));
      column.push_back(value);
    }
  }
  if (columns.empty()) file.fail(0, 0, "found an empty file; expected a table of power densities");
  if (values[0].size() < 2) file.fail(0, 0, format("found {} rows; expected two at least", values[0].size()));
  const auto spectrum = [&](std::size_t k) {
    return values[k].empty() ? platform::PowerSpectrum() : platform::PowerSpectrum(values[0], values[k]);
  };
  return {spectrum(1), spectrum(2), spectrum(3)};
}

}  // namespace ifov::io
