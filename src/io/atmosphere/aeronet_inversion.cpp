#include "io/atmosphere/aeronet_inversion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "core/format.h"

namespace ifov::io {
namespace {

constexpr double kMissing = -999.0;
constexpr int kLongestHead = 50;
constexpr std::size_t kMostColumns = 20000;

/// "AOD_Extinction-Total" and 0.44 of "AOD_Extinction-Total[440nm]".
struct Column {
  std::string_view name;
  double um;
};
std::optional<Column> column_of(std::string_view heading) {
  const std::size_t open = heading.find('[');
  if (open == std::string_view::npos || !heading.ends_with("nm]")) return std::nullopt;
  const std::optional<double> nm = number_in(heading.substr(open + 1, heading.size() - open - 4));
  if (!nm || !(*nm > 0.0)) return std::nullopt;
  return Column{heading.substr(0, open), 1e-3 * *nm};
}

/// "2019-08-15T21:46:45Z" of "15:08:2019" and "21:46:45"; as it stands where it is something else.
std::string iso_time(std::string_view date, std::string_view time) {
  if (date.size() != 10) return format("{} {}", date, time);
  return format("{}-{}-{}T{}Z", date.substr(6, 4), date.substr(3, 2), date.substr(0, 2), time);
}

/// The heading and the row of one retrieval.
struct Retrieval {
  std::vector<Field> heading, row;
  int heading_line = 0, line = 0;
  std::string site, time;

  Retrieval(const TextFile& file, const std::string& wanted) {
    for (int number = 1; number <= std::min(file.line_count(), kLongestHead) && heading_line == 0; ++number) {
      std::vector<Field> fields = split(file.line(number), ',');
      if (fields.size() < 4 || fields.size() > kMostColumns) continue;
      if (fields[0].text != "Site" && fields[0].text != "AERONET_Site") continue;
      heading = std::move(fields);
      heading_line = number;
    }
    if (heading_line == 0)
      file.fail(
          0, 0,
          "no line of headings that begins with 'Site,Date(dd:mm:yyyy)'; expected an inversion file of AERONET's version 3");
    const std::size_t date = find(file, "Date(dd:mm:yyyy)"), clock = find(file, "Time(hh:mm:ss)");
    int found = 0;
    std::string first, last;
    for (int number = heading_line + 1; number <= file.line_count(); ++number) {
      if (is_blank(file.line(number))) continue;
      std::vector<Field> fields = split(file.line(number), ',');
      // Some files end rows with a comma, and their headings without.
      if (fields.size() == heading.size() + 1 && fields.back().text.empty()) fields.pop_back();
      if (fields.size() != heading.size())
        file.fail(number, 0,
                  format("found {} columns; expected {} as in the heading", fields.size(), heading.size()));
      const std::string here = iso_time(fields[date].text, fields[clock].text);
      if (first.empty()) first = here;
      last = here;
      ++found;
      if (line != 0 && wanted.empty()) continue;
      if (!wanted.empty() && here != wanted) continue;
      row = std::move(fields);
      line = number;
      site = std::string(row[0].text);
      time = here;
    }
    if (found == 0) file.fail(heading_line, 0, "found no retrieval below the headings");
    if (wanted.empty() && found > 1)
      file.fail(
          heading_line, 0,
          format("found {} retrievals, from {} to {}; expected 'time' to say which", found, first, last));
    if (line == 0)
      file.fail(
          heading_line, 0,
          format("found no retrieval of {}; the file has {} from {} to {}", wanted, found, first, last));
  }

  std::size_t find(const TextFile& file, std::string_view name) const {
    for (std::size_t k = 0; k < heading.size(); ++k)
      if (heading[k].text == name) return k;
    file.fail(heading_line, 0,
              format("found no column '{}'; expected an inversion file of AERONET's version 3", name));
  }

  double number(const TextFile& file, std::size_t column) const {
    const std::optional<double> value = number_in(row[column].text);
    if (!value)
      file.fail(line, row[column].column, format("found '{}'; expected a number", row[column].text));
    return *value;
  }

  /// By wavelength, what is there of a quantity.
  std::map<double, double> values(const TextFile& file, std::string_view name) const {
    std::map<double, double> found;
    bool is_column = false;
    for (std::size_t k = 0; k < heading.size(); ++k) {
      const std::optional<Column> column = column_of(heading[k].text);
      if (!column || column->name != name) continue;
      is_column = true;
      const double value = number(file, k);
      if (value > kMissing + 1.0) found[column->um] = value;
    }
    if (!is_column)
      file.fail(heading_line, 0,
                format("found no columns '{}[...nm]'; expected them in a file of all products (.all)", name));
    return found;
  }
};

}  // namespace

AeronetInversion read_aeronet_inversion(const std::filesystem::path& path, const std::string& time) {
  return parse_aeronet_inversion(TextFile(path), time);
}

AeronetInversion parse_aeronet_inversion(const TextFile& file, const std::string& time) {
  const Retrieval retrieval(file, time);
  const auto depth = retrieval.values(file, "AOD_Extinction-Total"),
             albedo = retrieval.values(file, "Single_Scattering_Albedo"),
             asymmetry = retrieval.values(file, "Asymmetry_Factor-Total");
  AeronetInversion inversion;
  inversion.site = retrieval.site;
  inversion.time = retrieval.time;
  for (const auto& [um, value] : depth) {
    const auto a = albedo.find(um), g = asymmetry.find(um);
    if (a == albedo.end() || g == asymmetry.end()) continue;
    if (!(value > 0.0 && value < 50.0) || !(a->second >= 0.0 && a->second <= 1.0) ||
        !(std::abs(g->second) <= 0.99))
      file.fail(
          retrieval.line, 0,
          format(
              "found an optical depth of {:g}, an albedo of {:g} and an asymmetry of {:g} at {:g} um; expected a "
              "depth above 0, an albedo of 0 to 1 and an asymmetry of -0.99 to 0.99",
              value, a->second, g->second, um));
    inversion.wavelength_um.push_back(um);
    inversion.optical_depth.push_back(value);
    inversion.single_scattering_albedo.push_back(a->second);
    inversion.asymmetry.push_back(g->second);
  }
  if (inversion.wavelength_um.size() < 2)
    file.fail(
        retrieval.line, 0,
        format(
            "the retrieval of {} has optical depth, albedo and asymmetry together at {} wavelengths (-999: missing); "
            "expected two or more",
            retrieval.time, inversion.wavelength_um.size()));
  return inversion;
}

atmosphere::PhaseFunctionTable read_aeronet_phase_functions(const std::filesystem::path& path,
                                                            const std::string& time) {
  return parse_aeronet_phase_functions(TextFile(path), time);
}

atmosphere::PhaseFunctionTable parse_aeronet_phase_functions(const TextFile& file, const std::string& time) {
  constexpr double kOff = 0.02;  // of the integral: angles 1 to 4 degrees apart
  const Retrieval retrieval(file, time);
  std::map<double, std::map<double, double>> functions;  // by wavelength and angle
  for (std::size_t k = 0; k < retrieval.heading.size(); ++k) {
    const std::optional<Column> column = column_of(retrieval.heading[k].text);
    if (!column) continue;
    const std::optional<double> angle = number_in(column->name);
    if (!angle) continue;
    if (*angle < 0.0 || *angle > 180.0)
      file.fail(retrieval.heading_line, retrieval.heading[k].column,
                format("found an angle of {:g} deg; expected 0 to 180", *angle));
    const double value = retrieval.number(file, k);
    if (!(value > 0.0 && value < 1e12))
      file.fail(retrieval.line, retrieval.row[k].column,
                format("found '{}'; expected a phase function's value, above 0", retrieval.row[k].text));
    functions[column->um][*angle] = value;
  }
  if (functions.empty())
    file.fail(retrieval.heading_line, 0,
              "found no columns '180.000000[...nm]'; expected a file of phase functions (.pfn)");
  atmosphere::PhaseFunctionTable table;
  std::vector<double> angle_rad;
  for (const auto& [angle, value] : functions.begin()->second)
    angle_rad.push_back(angle == 180.0 ? std::numbers::pi : angle * std::numbers::pi / 180.0);
  if (angle_rad.size() < 4 || angle_rad.front() != 0.0 || angle_rad.back() != std::numbers::pi)
    file.fail(retrieval.heading_line, 0,
              format("found {} angles; expected 4 at least, from 0 to 180 deg", angle_rad.size()));
  table.angles = std::make_shared<const atmosphere::PhaseAngles>(std::move(angle_rad));
  for (const auto& [um, function] : functions) {
    if (function.size() != table.angles->angle_rad.size())
      file.fail(retrieval.heading_line, 0,
                format("found {} angles at {:g} um and {} at {:g} um; expected as many", function.size(), um,
                       table.angles->angle_rad.size(), functions.begin()->first));
    table.wavelength_um.push_back(um);
    std::vector<double>& logarithms = table.logarithms.emplace_back();
    for (const auto& [angle, value] : function) logarithms.push_back(std::log(value));
    const double mean = atmosphere::PhaseFunction(table.angles, logarithms).given_mean();
    if (std::abs(mean - 1.0) > kOff)
      file.fail(
          retrieval.line, 0,
          format(
              "the phase function of {:g} um has a mean of {:.4g} over the sphere; expected 1 within {:g} %",
              um, mean, 100.0 * kOff));
  }
  return table;
}

}  // namespace ifov::io
