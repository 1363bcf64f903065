#include "io/atmosphere/phase_function_file.h"

#include <cmath>
#include <numbers>

#include "core/format.h"

namespace ifov::io {
namespace {

constexpr std::size_t kLeastAngles = 4, kMostAngles = 2000, kMostWavelengths = 1000;
constexpr double kOff = 0.01;  // of the integral: what interpolation between angles and rounding make

std::vector<double> wavelengths_in(const TextFile& file, int number, const std::vector<Field>& heading) {
  if (heading.size() < 2 || heading.size() > kMostWavelengths + 1)
    file.fail(number, 0,
              format("found {} columns; expected an angle and 1 to {} wavelengths", heading.size(),
                     kMostWavelengths));
  if (number_in(heading[0].text))
    file.fail(number, heading[0].column,
              format("found '{}'; expected a heading: a word for the angle, then wavelengths in um",
                     heading[0].text));
  std::vector<double> um;
  for (std::size_t k = 1; k < heading.size(); ++k) {
    const std::optional<double> value = number_in(heading[k].text);
    if (!value || !(*value > 0.0))
      file.fail(number, heading[k].column,
                format("found '{}'; expected a wavelength in um, above 0", heading[k].text));
    if (!um.empty() && *value <= um.back())
      file.fail(number, heading[k].column, format("{:g} um does not rise above {:g} um", *value, um.back()));
    um.push_back(*value);
  }
  return um;
}

/// Of a function whose first step hides no peak that would explain it.
void check_integral(const TextFile& file, int heading, const Field& column, double um, double mean) {
  if (std::abs(mean - 1.0) <= kOff) return;
  const double steradians = 4.0 * std::numbers::pi;
  const char* hint = std::abs(mean * steradians - 1.0) <= kOff
                         ? "; it integrates to 1: multiply its values by 4 pi"
                     : std::abs(mean * 2.0 - 1.0) <= kOff || std::abs(mean * 0.5 - 1.0) <= kOff
                         ? "; its values seem to differ by a factor of 2"
                         : "";
  file.fail(
      heading, column.column,
      format("the phase function of {:g} um integrates to {:.4g} over the sphere, {:.3g} % {} 4 pi; expected "
             "{:.4g} within {:g} %{}",
             um, steradians * mean, 100.0 * std::abs(mean - 1.0), mean > 1.0 ? "more than" : "less than",
             steradians, 100.0 * kOff, hint));
}

}  // namespace

atmosphere::PhaseFunctionTable read_phase_functions(const std::filesystem::path& path) {
  return parse_phase_functions(TextFile(path));
}

atmosphere::PhaseFunctionTable parse_phase_functions(const TextFile& file) {
  atmosphere::PhaseFunctionTable table;
  std::vector<double> angle_rad;
  std::vector<Field> headings;
  int heading = 0, last_row = 0;
  double last = -1.0;
  char separator = '\0';
  for (int number = 1; number <= file.line_count(); ++number) {
    const std::string_view line = file.line(number);
    if (is_blank(line) || is_comment(line)) continue;
    if (separator == '\0') separator = separator_of(line);
    const std::vector<Field> fields = split(line, separator);
    if (heading == 0) {
      table.wavelength_um = wavelengths_in(file, number, fields);
      table.logarithms.resize(table.wavelength_um.size());
      headings = fields;
      heading = number;
      continue;
    }
    if (fields.size() != headings.size())
      file.fail(number, 0,
                format("found {} columns; expected {} as in the heading", fields.size(), headings.size()));
    const std::optional<double> angle = number_in(fields[0].text);
    if (!angle || *angle < 0.0 || *angle > 180.0)
      file.fail(number, fields[0].column,
                format("found '{}'; expected a scattering angle in deg, 0 to 180", fields[0].text));
    if (angle_rad.empty() ? *angle != 0.0 : *angle <= last)
      file.fail(number, fields[0].column,
                angle_rad.empty() ? format("found '{}'; expected the first angle to be 0", fields[0].text)
                                  : format("{:g} deg does not rise above {:g} deg", *angle, last));
    if (angle_rad.size() == kMostAngles) file.fail(number, 0, format("more than {} angles", kMostAngles));
    last = *angle;
    last_row = number;
    angle_rad.push_back(last == 180.0 ? std::numbers::pi : last * std::numbers::pi / 180.0);
    for (std::size_t k = 1; k < fields.size(); ++k) {
      const std::optional<double> value = number_in(fields[k].text);
      if (!value || !(*value > 0.0) || *value > 1e12)
        file.fail(number, fields[k].column,
                  format("found '{}'; expected a phase function's value, above 0", fields[k].text));
      table.logarithms[k - 1].push_back(std::log(*value));
    }
  }
  if (heading == 0) file.fail(0, 0, "it is empty; expected a heading and rows of angles");
  if (angle_rad.size() < kLeastAngles || last != 180.0)
    file.fail(last_row, 0,
              format("found {} angles{}; expected {} at least, from 0 to 180 deg", angle_rad.size(),
                     angle_rad.empty() ? std::string() : format(" up to {:g} deg", last), kLeastAngles));
  table.angles = std::make_shared<const atmosphere::PhaseAngles>(std::move(angle_rad));
  for (std::size_t k = 0; k < table.wavelength_um.size(); ++k)
    check_integral(file, heading, headings[k + 1], table.wavelength_um[k],
                   atmosphere::PhaseFunction(table.angles, table.logarithms[k]).given_mean());
  return table;
}

}  // namespace ifov::io
