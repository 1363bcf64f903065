#include <cmath>

#include "core/format.h"
#include "geodesy/utc_time.h"
#include "io/series_report/series_report.h"

namespace ifov::io {
namespace {

std::string second_text(double time_s) {
  return geodesy::format_utc({2440587.5, std::round(time_s) / 86400.0}).substr(0, 19) + "Z";
}

std::string kelvins(const std::vector<double>& values, std::size_t time) {
  return time < values.size() && std::isfinite(values[time]) ? format("{:.3f}", values[time]) : std::string();
}

}  // namespace

std::string series_csv(const SeriesReport& report) {
  std::string text = format("# materials of {} over time, by ifov\n", report.document);
  text += format("# brightness temperature of channel {}\n", report.channel);
  for (const std::string& note : report.notes) text += "# " + note + "\n";
  for (const SeriesReport::Crossover& one : report.crossovers)
    text += format("# {}{}: '{}' becomes warmer than '{}'\n", second_text(one.time_s),
                   one.when.empty() ? "" : format(" ({})", one.when), report.materials[one.warmer].name,
                   report.materials[one.cooler].name);
  if (report.crossovers.empty()) text += "# no crossovers\n";
  text += "time,material,pixels,brightness_k,brightness_deviation_k,surface_k,surface_deviation_k\n";
  for (std::size_t t = 0; t < report.time_s.size(); ++t)
    for (const SeriesReport::Material& material : report.materials)
      text +=
          format("{},{},{},{},{},{},{}\n", second_text(report.time_s[t]), material.name, material.pixels[t],
                 kelvins(material.brightness.mean_k, t), kelvins(material.brightness.deviation_k, t),
                 kelvins(material.surface.mean_k, t), kelvins(material.surface.deviation_k, t));
  return text;
}

}  // namespace ifov::io
