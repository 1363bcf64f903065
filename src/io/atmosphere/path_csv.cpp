#include "io/atmosphere/path_csv.h"

#include <algorithm>

#include "core/error.h"
#include "core/names.h"
#include "io/atmosphere/format_guess.h"
#include "io/atmosphere/spectral_table.h"

namespace ifov::io {
namespace {

std::optional<WavelengthUnit> unit_named(std::string_view heading) {
  if (heading == "wavelength_um") return WavelengthUnit::micrometres;
  if (heading == "wavelength_nm") return WavelengthUnit::nanometres;
  if (heading == "wavenumber_cm-1") return WavelengthUnit::wavenumber_per_cm;
  return std::nullopt;
}

}  // namespace

atmosphere::ImportedPath read_path_csv(const std::filesystem::path& path) {
  return parse_path_csv(TextFile(path));
}

atmosphere::ImportedPath parse_path_csv(const TextFile& file) {
  int number = 1;
  while (number <= file.line_count() && (is_blank(file.line(number)) || is_comment(file.line(number))))
    ++number;
  if (number > file.line_count()) file.fail(0, 0, "found an empty file; expected a table of paths (.csv)");
  const int heading_line = number;
  const std::vector<Field> heading = split(file.line(number++), ',');
  const std::optional<WavelengthUnit> unit = unit_named(heading[0].text);
  if (!unit)
    file.fail(heading_line, heading[0].column,
              format("found the heading '{}'; expected 'wavelength_um', 'wavelength_nm' or 'wavenumber_cm-1'",
                     heading[0].text) +
                  looks_like(file, "a table of paths (.csv)"));
  const std::vector<std::string> choices = atmosphere::path_quantity_names();
  std::vector<std::string> names;
  for (std::size_t i = 1; i < heading.size(); ++i) {
    const std::string name(heading[i].text);
    if (!atmosphere::path_quantity(name))
      file.fail(heading_line, heading[i].column,
                format("found the heading '{}'; expected {}{}", name, list_names(choices),
                       did_you_mean(name, choices)));
    if (std::find(names.begin(), names.end(), name) != names.end())
      file.fail(heading_line, heading[i].column, format("found '{}' twice; expected each column once", name));
    names.push_back(name);
  }
  if (names.empty()) file.fail(heading_line, 0, "found one column; expected at least two");
  SpectralTable table(file, *unit, names);
  for (; number <= file.line_count(); ++number) {
    if (is_blank(file.line(number)) || is_comment(file.line(number))) continue;
    const std::vector<Field> fields = split(file.line(number), ',');
    if (fields.size() != heading.size())
      file.fail(number, 0,
                format("found {} columns; expected {}, as in the heading", fields.size(), heading.size()));
    table.add(number, fields[0], std::span(fields).subspan(1));
  }
  if (table.size() == 0) file.fail(heading_line, 0, "found no rows below the heading");
  atmosphere::ImportedPath path(file.name(), table.wavelength_um());
  for (const std::string& name : names) path.set(*atmosphere::path_quantity(name), table.column(name));
  return path;
}

std::string path_csv(const atmosphere::ImportedPath& path) {
  std::string text = "wavelength_um";
  const std::vector<atmosphere::PathQuantity> quantities = path.quantities();
  for (const auto quantity : quantities) text += format(",{}", atmosphere::name_of(quantity));
  text += "\n";
  for (std::size_t i = 0; i < path.wavelength_um().size(); ++i) {
    text += format("{}", path.wavelength_um()[i]);
    for (const auto quantity : quantities) text += format(",{}", path.column(quantity)[i]);
    text += "\n";
  }
  return text;
}

}  // namespace ifov::io
