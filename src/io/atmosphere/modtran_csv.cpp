#include "io/atmosphere/modtran_csv.h"

#include <algorithm>

#include "core/error.h"
#include "io/atmosphere/format_guess.h"

namespace ifov::io {
namespace {

constexpr std::string_view kFormat = "table of MODTRAN 6 (.csv)";

struct Heading {
  std::vector<std::string> names;
  std::vector<std::size_t> fields;  ///< of a row, for each name
  std::size_t width = 0;
  std::optional<WavelengthUnit> unit;
  ModtranMode mode = ModtranMode::radiance;
};

bool is_heading(std::string_view line) {
  const std::vector<Field> fields = split(line, ',');
  return fields.size() >= 2 && modtran_spectral_heading(fields[0].text).has_value();
}

bool starts_with_number(std::string_view line) {
  const std::vector<Field> fields = split(line, ',');
  return !fields.empty() && fortran_number(fields[0].text).has_value();
}

/// A heading without the unit that may follow in brackets: "Total Rad (W/cm2/sr/nm)".
std::string_view bare(std::string_view heading) {
  const std::size_t bracket = heading.find_first_of("([");
  if (bracket == std::string_view::npos || heading.substr(bracket) == "[K]") return heading;
  return heading.substr(0, heading.find_last_not_of(" \t", bracket == 0 ? 0 : bracket - 1) + 1);
}

Heading read_heading(const TextFile& file, int number) {
  Heading heading;
  const std::vector<Field> fields = split(file.line(number), ',');
  heading.width = fields.size();
  heading.unit = modtran_spectral_heading(fields[0].text)->unit;
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const std::optional<std::string> name = modtran_column(bare(fields[i].text));
    if (!name) continue;  // single gases, DEPTH of other versions
    if (std::find(heading.names.begin(), heading.names.end(), *name) != heading.names.end())
      file.fail(number, fields[i].column, format("found {} twice; expected each column once", *name));
    heading.names.push_back(*name);
    heading.fields.push_back(i);
  }
  const auto has = [&](std::string_view name) {
    return std::find(heading.names.begin(), heading.names.end(), name) != heading.names.end();
  };
  if (has("TOTAL_RAD"))
    heading.mode = ModtranMode::radiance;
  else if (has("SOL_TR"))
    heading.mode = ModtranMode::solar_irradiance;
  else if (has("TOT_TRANS"))
    heading.mode = ModtranMode::transmittance;
  else
    file.fail(number, 0,
              "found headings without total transmittance, total radiance or transmitted solar irradiance; "
              "expected "
              "one of them");
  return heading;
}

/// Units that radiances and irradiances may have here besides those per unit of the spectral column.
void check_units(const TextFile& file, int number, WavelengthUnit unit) {
  for (const Field& field : split(file.line(number), ',')) {
    std::string text = lower_case(field.text);
    std::erase_if(
        text, [](char symbol) { return symbol == ' ' || symbol == '^' || symbol == '(' || symbol == ')'; });
    if (!text.starts_with("w") || text.starts_with("wav")) continue;
    const bool area = text.find("cm2") != std::string::npos || text.find("cm-2") != std::string::npos;
    const std::string_view per = unit == WavelengthUnit::wavenumber_per_cm ? "cm-1"
                                 : unit == WavelengthUnit::nanometres      ? "nm"
                                                                           : "um";
    if (!area || text.find(per) == std::string::npos)
      file.fail(number, field.column,
                format("found the unit '{}'; expected W cm-2 (sr-1) per {}, the unit of the spectral column",
                       field.text, per));
  }
}

}  // namespace

std::vector<ModtranRun> read_modtran_csv(const std::filesystem::path& path,
                                         std::optional<WavelengthUnit> unit) {
  return parse_modtran_csv(TextFile(path), unit);
}

std::vector<ModtranRun> parse_modtran_csv(const TextFile& file, std::optional<WavelengthUnit> given_unit) {
  std::vector<ModtranRun> runs;
  int number = 1;
  const auto at_heading = [&] {
    while (number <= file.line_count() && !is_heading(file.line(number))) {
      if (starts_with_number(file.line(number)))
        file.fail(number, 0,
                  "found numbers where a heading was expected, such as 'Freq (cm-1), tot_trans, total_rad'" +
                      looks_like(file, kFormat));
      ++number;
    }
    return number <= file.line_count();
  };
  while (at_heading()) {
    const int heading_line = number;
    const Heading heading = read_heading(file, number++);
    std::optional<WavelengthUnit> unit = given_unit ? given_unit : heading.unit;
    const bool units_below =
        number <= file.line_count() && !is_blank(file.line(number)) && !starts_with_number(file.line(number));
    if (units_below) {
      const std::vector<Field> units = split(file.line(number), ',');
      const auto stated = modtran_spectral_heading("wavelength " + std::string(units[0].text));
      if (!given_unit && stated && stated->unit) unit = stated->unit;
      if (!given_unit && lower_case(units[0].text).find("cm-1") != std::string::npos)
        unit = WavelengthUnit::wavenumber_per_cm;
    }
    if (!unit)
      file.fail(heading_line, 1,
                "found no unit of the spectral column; expected cm-1, nm or um in its heading or "
                "in the line below");
    if (units_below) check_units(file, number++, *unit);
    SpectralTable table(file, *unit, heading.names);
    while (number <= file.line_count() && starts_with_number(file.line(number))) {
      const std::vector<Field> fields = split(file.line(number), ',');
      if (fields[0].text.starts_with("-9999")) {
        ++number;
        break;
      }
      if (fields.size() != heading.width)
        file.fail(number, 0,
                  format("found {} columns; expected {}, as in the heading of line {}", fields.size(),
                         heading.width, heading_line));
      std::vector<Field> cells;
      for (const std::size_t field : heading.fields) cells.push_back(fields[field]);
      table.add(number++, fields[0], cells);
    }
    if (table.size() == 0) file.fail(heading_line, 0, "found no rows below this heading");
    std::string source = file.name();
    if (heading_line > 4 || !runs.empty()) source += format(", case at line {}", heading_line);
    runs.push_back({heading.mode, heading_line, modtran_path(table, heading.mode, source)});
  }
  if (runs.empty())
    file.fail(0, 0,
              "found no heading that begins with Freq or Wavelength; expected a table of MODTRAN 6 (.csv)" +
                  looks_like(file, kFormat));
  return runs;
}

}  // namespace ifov::io
