#include "io/spectra/brdf_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/error.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

constexpr std::size_t kIsotropic = 5, kAll = 6;
constexpr std::size_t kMostRows = 2'000'000;

struct Column {
  const char* name;
  double low, high;
  bool above_low, below_high;
};
constexpr Column kLightZenith{"zenith angle of the light in deg, 0 to below 90", 0.0, 90.0, false, true},
    kViewZenith{"zenith angle of the view in deg, 0 to below 90", 0.0, 90.0, false, true},
    kBetween{"azimuth in deg, 0 to 180", 0.0, 180.0, false, false},
    kLightAzimuth{"azimuth of the light in deg, 0 to below 360", 0.0, 360.0, false, true},
    kViewAzimuth{"azimuth of the view in deg, 0 to below 360", 0.0, 360.0, false, true},
    kWavelength{"wavelength in um, above 0", 0.0, 1e6, true, false},
    kValue{"BRDF in 1/sr, at least 0", 0.0, 1e6, false, false};
constexpr std::array<Column, kIsotropic> kIsotropicColumns{kLightZenith, kViewZenith, kBetween, kWavelength,
                                                           kValue};
constexpr std::array<Column, kAll> kAllColumns{kLightZenith, kLightAzimuth, kViewZenith,
                                               kViewAzimuth, kWavelength,   kValue};

std::span<const Column> columns(std::size_t count) {
  if (count == kAll) return kAllColumns;
  return kIsotropicColumns;
}

struct BrdfRow {
  std::array<double, kAll> value;
  int line;
};

struct BrdfRows {
  std::vector<BrdfRow> rows;
  std::size_t columns = 0;
};

BrdfRows rows_of(const TextFile& file) {
  BrdfRows found;
  std::vector<BrdfRow>& rows = found.rows;
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
    if (rows.empty() && (fields.size() == kIsotropic || fields.size() == kAll)) found.columns = fields.size();
    if (fields.size() != found.columns)
      file.fail(
          number, 0,
          rows.empty()
              ? format(
                    "found {} columns; expected 5: zenith angle of the light, of the view, azimuth, wavelength, BRDF; "
                    "or 6: zenith angle and azimuth of the light, both of the view, wavelength, BRDF",
                    fields.size())
              : format("found {} columns; expected {} as in the rows before", fields.size(), found.columns));
    BrdfRow row{{}, number};
    for (std::size_t k = 0; k < found.columns; ++k) {
      const Column& column = columns(found.columns)[k];
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
  return found;
}

}  // namespace

materials::MeasuredBrdf read_brdf_table(const std::filesystem::path& path) {
  return parse_brdf_table(TextFile(path));
}

materials::MeasuredBrdf parse_brdf_table(const TextFile& file) {
  BrdfRows found = rows_of(file);
  std::vector<BrdfRow>& rows = found.rows;
  const std::size_t value = found.columns - 1, wavelength = value - 1;
  const bool isotropic = found.columns == kIsotropic;
  std::vector<std::vector<double>> axes(value);
  for (std::size_t k = 0; k < axes.size(); ++k) {
    for (const BrdfRow& row : rows) axes[k].push_back(row.value[k]);
    std::sort(axes[k].begin(), axes[k].end());
    axes[k].erase(std::unique(axes[k].begin(), axes[k].end()), axes[k].end());
  }
  const auto angles = [&](const BrdfRow& row) {
    const auto& v = row.value;
    return isotropic
               ? format("light {:g} deg, view {:g} deg, azimuth {:g} deg, {:g} um", v[0], v[1], v[2], v[3])
               : format("light {:g} deg in azimuth {:g} deg, view {:g} deg in azimuth {:g} deg, {:g} um",
                        v[0], v[1], v[2], v[3], v[4]);
  };
  const auto is_before = [&](const BrdfRow& a, const BrdfRow& b) {
    const auto end = static_cast<std::ptrdiff_t>(value);
    return std::lexicographical_compare(a.value.begin(), a.value.begin() + end, b.value.begin(),
                                        b.value.begin() + end);
  };
  std::stable_sort(rows.begin(), rows.end(), is_before);
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (!is_before(rows[k - 1], rows[k]))
      file.fail(rows[k].line, 0, format("{}: given before, in line {}", angles(rows[k]), rows[k - 1].line));
  double expected = 1.0;  // beyond what integers hold, in a bad file
  for (const std::vector<double>& axis : axes) expected *= static_cast<double>(axis.size());
  if (static_cast<double>(rows.size()) != expected) {
    // The first combination that no row has: the last column changes fastest.
    std::vector<std::size_t> at(axes.size(), 0);
    BrdfRow wanted{{}, 0};
    for (std::size_t k = 0;; ++k) {
      for (std::size_t a = 0; a < axes.size(); ++a) wanted.value[a] = axes[a][at[a]];
      if (k == rows.size() || is_before(wanted, rows[k])) break;
      for (std::size_t a = axes.size(); a-- > 0;) {
        if (++at[a] < axes[a].size()) break;
        at[a] = 0;
      }
    }
    const std::string azimuths = isotropic ? format("{} azimuths", axes[2].size())
                                           : format("{} and {} azimuths", axes[1].size(), axes[3].size());
    file.fail(0, 0,
              format("no row for {}: {} rows, where every combination of {} and {} zenith angles, {} "
                     "and {} wavelengths makes {:.0f}",
                     angles(wanted), rows.size(), axes[0].size(), axes[isotropic ? 1 : 2].size(), azimuths,
                     axes[wavelength].size(), expected));
  }
  materials::MeasuredBrdf table;
  const auto radians = [](std::vector<double> values) {
    for (double& angle : values) angle *= math::kDegree;
    return values;
  };
  table.zenith_in_rad = radians(axes[0]);
  table.zenith_out_rad = radians(axes[isotropic ? 1 : 2]);
  if (isotropic) {
    table.azimuth_rad = radians(axes[2]);
  } else {
    table.azimuth_in_rad = radians(axes[1]);
    table.azimuth_out_rad = radians(axes[3]);
  }
  table.wavelength_um = axes[wavelength];
  for (const BrdfRow& row : rows) table.brdf.push_back(row.value[value]);
  return table;
}

}  // namespace ifov::io
