#include "io/weather/weather_file.h"

#include <sstream>
#include <string>

#include "core/format.h"

namespace ifov::io {
namespace {

/// Rows and hours between them, as weather histories of DIRSIG begin (".wth"; dirsig.cis.rit.edu).
bool begins_as_dirsig(std::string_view line) {
  std::istringstream text{std::string(line)};
  int rows = 0;
  double hours = 0.0;
  std::string more;
  return text >> rows >> hours && !(text >> more) && rows > 1 && hours > 0.0 && hours <= 24.0;
}

}  // namespace

atmosphere::WeatherSeries read_weather(const std::filesystem::path& path, const WeatherOptions& options) {
  return parse_weather(TextFile(path), options);
}

atmosphere::WeatherSeries parse_weather(const TextFile& file, const WeatherOptions& options) {
  const std::string_view first = file.line_count() > 0 ? file.line(1) : std::string_view();
  const std::string_view second = file.line_count() > 1 ? file.line(2) : std::string_view();
  if (first.starts_with("LOCATION,")) return parse_epw(file, options);
  if (second.starts_with("Date (MM/DD/YYYY),")) return parse_tmy3(file, options);
  if (second.find("version") != std::string_view::npos) return parse_surfrad(file, options);
  for (int number = 1; number <= file.line_count(); ++number) {
    const std::string_view line = file.line(number);
    if (is_blank(line) || is_comment(line)) continue;
    const std::vector<Field> fields = split(line, ',');
    if (fields[0].text == "time" || fields[0].text == "hour_utc") return parse_weather_csv(file, options);
    break;
  }
  if (begins_as_dirsig(first))
    file.fail(
        1, 0,
        format(
            "found '{}', rows and hours between them, as weather histories of DIRSIG begin: their columns are not read here, and "
            "tell neither date nor zone; expected a table whose first heading is 'time' or 'hour_utc'",
            first));
  file.fail(file.line_count() > 0 ? 1 : 0, 0,
            "found no weather that is known here; expected EPW (LOCATION,...), TMY3, SURFRAD, or a table "
            "whose first "
            "heading is 'time' or 'hour_utc'");
}

}  // namespace ifov::io
