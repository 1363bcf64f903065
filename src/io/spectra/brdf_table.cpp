#include "io/spectra/brdf_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

constexpr std::size_t kColumns = 5;
constexpr std::size_t kMostRows = 2'000'000;

struct Column {
  const char* name;
  double low, high;
  bool above_low, below_high;
};
constexpr Column kBrdfColumns[kColumns] = {
    {"zenith angle of the light in deg, 0 to below 90", 0.0, 90.0, false, true},
    {"zenith angle of the view in deg, 0 to below 90", 0.0, 90.0, false, true},
    {"azimuth in deg, 0 to 180", 0.0, 180.0, false, false},
    {"wavelength in um, above 0", 0.0, 1e6, true, false},
    {"BRDF in 1/sr, at least 0", 0.0, 1e6, false, false},
};

struct BrdfRow {
  std::array<double, kColumns> value;
  int line;
};

std::vector<BrdfRow> rows_of(const TextFile& file) {
  std::vector<BrdfRow> rows;
  char separator = '\0';
  for (int number = 1; number <= file.line_count(); ++number) {
    const std::string_view line = file.line(number);
    if (is_blank(line) || is_comment(line)) continue;
    if (separator == '\0') separator = separator_of(line);
    const std::vector<Field> fields = split(line, separator);
    if (rows.empty() && !fields.empty() && !number_in(fields[0].text)) {
      separator = '\0';  // a heading may be prose
      continue;
    }
    if (fields.size() != kColumns)
      file.fail(
          number, 0,
          format(
              "found {} columns; expected 5: zenith angle of the light, of the view, azimuth, wavelength, BRDF",
              fields.size()));
    BrdfRow row{{}, number};
    for (std::size_t k = 0; k < kColumns; ++k) {
      const Column& column = kBrdfColumns[k];
      const std::optional<double> value = number_in(fields[k].text);
      if (!value || *value < column.low || *value > column.high ||
          (column.above_low && *value <= column.low) || (column.below_high && *value >= column.high))
        file.fail(number, fields[k].column, format("found '{}'; expected {}", fields[k].text, column.name));
      row.value[k] = *value;
    }
    if (rows.size() == kMostRows) file.fail(number, 0, format("more than {} rows", kMostRows));
    rows.push_back(row);
  }
  if (rows.empty()) file.fail(0, 0, "no row of numbers");
  return rows;
}

}  // namespace

materials::MeasuredBrdf read_brdf_table(const std::filesystem::path& path) {
  return parse_brdf_table(TextFile(path));
}

materials::MeasuredBrdf parse_brdf_table(const TextFile& file) {
  std::vector<BrdfRow> rows = rows_of(file);
  std::array<std::vector<double>, kColumns - 1> axes;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    for (const BrdfRow& row : rows) axes[k].push_back(row.value[k]);
    std::sort(axes[k].begin(), axes[k].end());
    axes[k].erase(std::unique(axes[k].begin(), axes[k].end()), axes[k].end());
  }
  const auto angles = [](const BrdfRow& row) {
    return format("light {:g} deg, view {:g} deg, azimuth {:g} deg, {:g} um", row.value[0], row.value[1],
                  row.value[2], row.value[3]);
  };
  const auto is_before = [](const BrdfRow& a, const BrdfRow& b) {
    return std::lexicographical_compare(a.value.begin(), a.value.end() - 1, b.value.begin(),
                                        b.value.end() - 1);
  };
  std::stable_sort(rows.begin(), rows.end(), is_before);
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (!is_before(rows[k - 1], rows[k]))
      file.fail(rows[k].line, 0, format("{}: given before, in line {}", angles(rows[k]), rows[k - 1].line));
  double expected = 1.0;  // beyond what integers hold, in a bad file
  for (const std::vector<double>& axis : axes) expected *= static_cast<double>(axis.size());
  if (static_cast<double>(rows.size()) != expected) {
    // The first combination that no row has.
    std::size_t k = 0;
    BrdfRow wanted{{}, 0};
    for (const double in : axes[0])
      for (const double out : axes[1])
        for (const double azimuth : axes[2])
          for (const double um : axes[3]) {
            wanted.value = {in, out, azimuth, um, 0.0};
            if (k == rows.size() || is_before(wanted, rows[k]))
              file.fail(
                  0, 0,
                  format(
                      "no row for {}: {} rows, where every combination of {} and {} zenith angles, {} azimuths "
                      "and {} wavelengths makes {:.0f}",
                      angles(wanted), rows.size(), axes[0].size(), axes[1].size(), axes[2].size(),
                      axes[3].size(), expected));
            ++k;
          }
  }
  materials::MeasuredBrdf table;
  const auto radians = [](std::vector<double> values) {
    for (double& value : values) value *= math::kDegree;
    return values;
  };
  table.zenith_in_rad = radians(axes[0]);
  table.zenith_out_rad = radians(axes[1]);
  table.azimuth_rad = radians(axes[2]);
  table.wavelength_um = axes[3];
  for (const BrdfRow& row : rows) table.brdf.push_back(row.value[4]);
  return table;
}

}  // namespace ifov::io
