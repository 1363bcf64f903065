#include "io/atmosphere/modtran_channels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.h"
#include "io/atmosphere/format_guess.h"
#include "io/atmosphere/spectral_table.h"

namespace ifov::io {
namespace {

using Q = atmosphere::PathQuantity;

constexpr std::size_t kNumbers = 26;  // before the description
constexpr double kPerSquareMetre = 1e4;

// Columns that are used, from 0.
enum Column : std::size_t {
  kMoment = 0,
  kLineOfSight = 1,
  kChannel = 2,
  kRadiance = 6,
  kWidth = 8,
  kThermalEmission = 11,
  kThermalScatter = 12,
  kSurfaceEmission = 13,
  kMultipleScatter = 14,
  kSingleScatter = 15,
  kGroundReflected = 16,
  kDirectReflected = 17,
  kCosSun = 18,
  kSunPath = 19,
  kSunToSensor = 20,
  kDirectCoefficient = 21,
  kDiffuseCoefficient = 22,
  kSphericalAlbedo = 23,
  kTransmittance = 24,
  kEmissivity = 25,
};

struct Rows {
  std::vector<std::array<double, kNumbers>> values;
  std::vector<int> lines;
};

bool is_rule(std::string_view line) {
  return line.size() > 20 && line.find_first_not_of("- ") == std::string_view::npos &&
         line.find('-') != std::string_view::npos;
}

class Reader {
 public:
  Reader(const TextFile& file, std::optional<double> sun_zenith_rad)
      : file_(file), sun_zenith_rad_(sun_zenith_rad) {}

  std::vector<atmosphere::ImportedPath> read() {
    for (int number = 1; number <= file_.line_count();) {
      if (is_blank(file_.line(number))) {
        ++number;
        continue;
      }
      number = read_block(number);
    }
    if (paths_.empty()) file_.fail(0, 0, "found an empty file; expected a MODTRAN channel file (.chn)");
    return std::move(paths_);
  }

 private:
  int read_block(int first) {
    if (file_.line(first).find("1ST SPECTRAL") == std::string_view::npos)
      file_.fail(first, 0,
                 "found no heading '1ST SPECTRAL MOMENT'; expected a MODTRAN channel file (.chn)" +
                     looks_like(file_, "channel file (.chn)"));
    int rule = first;
    while (rule <= file_.line_count() && rule < first + 6 && !is_rule(file_.line(rule))) ++rule;
    if (rule > file_.line_count() || !is_rule(file_.line(rule)))
      file_.fail(first, 0,
                 "found no line of dashes below these headings; expected one that shows the columns");
    const double um_per_unit = unit_in(first, rule);
    const std::vector<std::size_t> ends = ends_of(rule);
    int number = rule + 1;
    std::map<double, Rows> lines_of_sight;
    while (number <= file_.line_count() && !is_blank(file_.line(number)) &&
           file_.line(number).find("1ST SPECTRAL") == std::string_view::npos)
      read_row(number++, ends, lines_of_sight);
    if (lines_of_sight.empty()) file_.fail(rule, 0, "found no channels below this line");
    for (const auto& [line_of_sight, rows] : lines_of_sight)
      add_path(first, line_of_sight, rows, um_per_unit);
    return number;
  }

  double unit_in(int first, int rule) const {
    for (int number = first; number < rule; ++number) {
      const std::string_view line = file_.line(number);
      if (line.find("(NANOMETERS)") != std::string_view::npos) return 1e-3;
      if (line.find("(MICRO") != std::string_view::npos) return 1.0;
    }
    file_.fail(first, 0,
               "found no unit of the first column in these headings; expected (NANOMETERS) or (MICRONS)");
  }

  std::vector<std::size_t> ends_of(int rule) const {
    std::vector<std::size_t> ends;
    for (const Field& dashes : split(file_.line(rule), ' '))
      ends.push_back(static_cast<std::size_t>(dashes.column - 1) + dashes.text.size());
    if (ends.size() < kNumbers)
      file_.fail(rule, 0,
                 format("found {} columns; expected {} of MODTRAN 5.3 or later", ends.size(), kNumbers));
    return ends;
  }

  /// Numbers are flush right and may touch, so a row is cut at the ends of the dashes.
  void read_row(int number, const std::vector<std::size_t>& ends,
                std::map<double, Rows>& lines_of_sight) const {
    const std::string_view line = file_.line(number);
    std::array<double, kNumbers> values{};
    for (std::size_t i = 0, begin = 0; i < kNumbers; begin = ends[i++]) {
      const std::string_view cell = line.substr(std::min(begin, line.size()), ends[i] - begin);
      const std::vector<Field> words = split(cell, ' ');
      const int column = static_cast<int>(begin) + (words.empty() ? 1 : words[0].column);
      if (words.empty())
        file_.fail(number, column, format("found nothing in column {}; expected a number", i + 1));
      const std::optional<double> value = fortran_number(words[0].text);
      if (words.size() > 1 || !value)
        file_.fail(number, column,
                   format("found '{}' in column {}; expected a number",
                          cell.substr(cell.find_first_not_of(' ')), i + 1));
      values[i] = *value;
    }
    if (!(values[kMoment] > 0.0))
      file_.fail(number, 1, format("found a wavelength of {:g}; expected one above 0", values[kMoment]));
    if (!(values[kWidth] > 0.0))
      file_.fail(number, 1, format("found a channel width of {:g}; expected one above 0", values[kWidth]));
    Rows& rows = lines_of_sight[values[kLineOfSight]];
    rows.values.push_back(values);
    rows.lines.push_back(number);
  }

  void add_path(int first, double line_of_sight, const Rows& given, double um_per_unit) {
    std::vector<std::size_t> order(given.values.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return given.values[a][kMoment] < given.values[b][kMoment];
    });
    std::vector<double> um, width_um;
    for (std::size_t k = 0; k < order.size(); ++k) {
      const auto& row = given.values[order[k]];
      if (k > 0 && row[kMoment] == given.values[order[k - 1]][kMoment])
        file_.fail(given.lines[order[k]], 1,
                   format("found a channel at {:g} twice; expected each once", row[kMoment]));
      um.push_back(row[kMoment] * um_per_unit);
      width_um.push_back(row[kWidth] * um_per_unit);
    }
    if (!paths_.empty()) same_channels(um, given, order);
    std::string source = file_.name();
    if (first > 2) source += format(", block at line {}", first);
    if (line_of_sight != 1.0) source += format(", line of sight {}", line_of_sight);
    atmosphere::ImportedPath path(source, um);
    path.width_um = width_um;
    fill(path, [&](Column column, double factor) {
      std::vector<double> values;
      for (const std::size_t i : order) values.push_back(given.values[i][column] * factor);
      return values;
    });
    paths_.push_back(std::move(path));
  }

  void same_channels(const std::vector<double>& um, const Rows& rows,
                     const std::vector<std::size_t>& order) const {
    const auto expected = paths_.front().wavelength_um();
    if (um.size() != expected.size())
      file_.fail(rows.lines.front(), 0,
                 format("found a block of {} channels; expected {}, as in the first block", um.size(),
                        expected.size()));
    for (std::size_t i = 0; i < um.size(); ++i)
      if (std::abs(um[i] / expected[i] - 1.0) > 1e-4)
        file_.fail(rows.lines[order[i]], 1,
                   format("found a channel at {:g} um; expected one at {:g} um, as in the first block", um[i],
                          expected[i]));
  }

  template <class Take>
  void fill(atmosphere::ImportedPath& path, const Take& take) const {
    const auto mean = [&](std::vector<double> values) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] *= kPerSquareMetre / path.width_um[i];
      return values;
    };
    const auto mean_of_sum = [&](Column a, Column b) {
      std::vector<double> values = take(a, 1.0);
      const std::vector<double> more = take(b, 1.0);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] += more[i];
      return mean(std::move(values));
    };
    path.set(Q::total_radiance, mean(take(kRadiance, 1.0)));
    path.set(Q::thermal_path_radiance, mean_of_sum(kThermalEmission, kThermalScatter));
    path.set(Q::surface_emission, mean(take(kSurfaceEmission, 1.0)));
    path.set(Q::solar_path_radiance, mean_of_sum(kMultipleScatter, kSingleScatter));
    path.set(Q::single_scatter_path_radiance, mean(take(kSingleScatter, 1.0)));
    path.set(Q::ground_reflected_radiance, mean(take(kGroundReflected, 1.0)));
    path.set(Q::direct_reflected_radiance, mean(take(kDirectReflected, 1.0)));
    path.set(Q::sun_at_sensor, mean(take(kSunToSensor, 1.0)));
    path.set(Q::spherical_albedo, take(kSphericalAlbedo, 1.0));
    path.set(Q::ground_sensor_transmittance, take(kTransmittance, 1.0));
    path.set(Q::surface_emissivity, take(kEmissivity, 1.0));
    std::vector<double> sun_ground = quotient(take(kDirectCoefficient, 1.0), take(kTransmittance, 1.0));
    path.set(Q::diffuse_ground_sensor_transmittance, quotient(take(kDiffuseCoefficient, 1.0), sun_ground));
    path.set(Q::sun_ground_transmittance, std::move(sun_ground));
    if (!sun_zenith_rad_) return;
    path.geometry.sun_zenith_rad = sun_zenith_rad_;
    const std::vector<double> sun = take(kCosSun, std::numbers::pi / std::cos(*sun_zenith_rad_));
    path.set(Q::solar_irradiance, mean(sun));
    path.set(Q::two_way_transmittance, quotient(take(kSunPath, 1.0), sun));
  }

  /// 0 where both are 0: MODTRAN's seven decimals leave nothing of an opaque path. A ratio of rounding errors
  /// may exceed 1 there, too.
  static std::vector<double> quotient(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      result[i] = b[i] > 0.0 ? std::clamp(a[i] / b[i], 0.0, 1.0) : 0.0;
    return result;
  }

  const TextFile& file_;
  std::optional<double> sun_zenith_rad_;
  std::vector<atmosphere::ImportedPath> paths_;
};

}  // namespace

std::vector<atmosphere::ImportedPath> read_modtran_channels(const std::filesystem::path& path,
                                                            std::optional<double> sun_zenith_rad) {
  return parse_modtran_channels(TextFile(path), sun_zenith_rad);
}

std::vector<atmosphere::ImportedPath> parse_modtran_channels(const TextFile& file,
                                                             std::optional<double> sun_zenith_rad) {
  return Reader(file, sun_zenith_rad).read();
}

}  // namespace ifov::io
