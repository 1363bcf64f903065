#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "geodesy/utc_time.h"
#include "io/temperature_report/temperature_report.h"

namespace ifov::io {
namespace {

constexpr double kFreezing_k = 273.15, kHour_s = 3600.0;
constexpr std::size_t kMostCrossovers = 40;

std::string utc_text(double time_s) { return geodesy::format_utc({2440587.5, std::round(time_s) / 86400.0}); }
std::string minute_text(double time_s) { return utc_text(time_s + 30.0).substr(11, 5); }

double sunlight(const thermal::Fluxes& fluxes) { return fluxes.sun + fluxes.sky + fluxes.reflected; }
double longwave(const thermal::Fluxes& fluxes) {
  return fluxes.sky_longwave + fluxes.ground_longwave + fluxes.emitted;
}

std::string point_rows(const TemperatureReport& report, const TemperatureReport::Material& material) {
  std::string text =
      "            air    here  sunlit  shaded |    Sun   sky | W m-2 here: direct    sky  reflected | long-wave: sky  around  emitted | "
      "convection  latent  into the solid\n"
      "   UTC     degC    degC    degC    degC | % seen    %\n";
  double next_s = report.time_s.front();
  for (std::size_t i = 0; i < report.time_s.size(); ++i) {
    if (report.time_s[i] < next_s - 1.0) continue;
    next_s = report.time_s[i] + kHour_s;
    const thermal::Fluxes& f = material.here->day.fluxes[i];
    text += format(
        "  {}   {:6.2f}  {:6.2f}  {:6.2f}  {:6.2f} | {:6.0f}  {:4.0f} |{:19.1f} {:6.1f}  {:9.1f} |{:15.1f}  {:6.1f}  {:7.1f} | "
        "{:10.1f}  {:6.1f}  {:14.1f}\n",
        minute_text(report.time_s[i]), report.air_k[i] - kFreezing_k,
        material.here->day.surface_k[i] - kFreezing_k, material.sunlit.surface_k[i] - kFreezing_k,
        material.shaded.surface_k[i] - kFreezing_k, 100.0 * material.here->sun_seen[i],
        100.0 * material.here->free_sky[i], f.sun, f.sky, f.reflected, f.sky_longwave, f.ground_longwave,
        f.emitted, f.convection, f.latent, f.sum());
  }
  return text;
}

std::string material_table(const TemperatureReport& report, const TemperatureReport::Material& material) {
  std::string text = format("\n{}\n", material.name);
  for (const std::string& line : material.description) text += "  " + line + "\n";
  text += format("  heat that is not accounted for: {:.1e} of what came in\n", material.unaccounted);
  if (material.here) return text + point_rows(report, material);
  text +=
      "            air  sunlit  shaded | W m-2 in the Sun: sunlight  long-wave  convection  latent  into the solid\n"
      "   UTC     degC    degC    degC\n";
  double next_s = report.time_s.front();
  for (std::size_t i = 0; i < report.time_s.size(); ++i) {
    if (report.time_s[i] < next_s - 1.0) continue;
    next_s = report.time_s[i] + kHour_s;
    const thermal::Fluxes& fluxes = material.sunlit.fluxes[i];
    text += format("  {}   {:6.2f}  {:6.2f}  {:6.2f} |{:27.1f}  {:9.1f}  {:10.1f}  {:6.1f}  {:14.1f}\n",
                   minute_text(report.time_s[i]), report.air_k[i] - kFreezing_k,
                   material.sunlit.surface_k[i] - kFreezing_k, material.shaded.surface_k[i] - kFreezing_k,
                   sunlight(fluxes), longwave(fluxes), fluxes.convection, fluxes.latent, fluxes.sum());
  }
  return text;
}

std::string crossover_lines(const TemperatureReport& report) {
  if (report.materials.size() < 2) return {};
  std::string text = "\nCrossovers, of sunlit surfaces\n";
  if (report.crossovers.empty()) return text + "  none\n";
  for (std::size_t i = 0; i < std::min(report.crossovers.size(), kMostCrossovers); ++i) {
    const TemperatureReport::Crossover& one = report.crossovers[i];
    text += format("  {}  '{}' becomes warmer than '{}'\n", minute_text(one.time_s),
                   report.materials[one.warmer].name, report.materials[one.cooler].name);
  }
  if (report.crossovers.size() > kMostCrossovers)
    text += format("  and {} more; --csv has all curves\n", report.crossovers.size() - kMostCrossovers);
  return text;
}

void add_rows(std::string& text, const TemperatureReport& report, const std::string& name, const char* light,
              const TemperatureReport::Day& day) {
  for (std::size_t i = 0; i < report.time_s.size(); ++i) {
    const thermal::Fluxes& f = day.fluxes[i];
    text += format(
        "\"{}\",{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}\n",
        name, light, utc_text(report.time_s[i]), report.air_k[i], day.surface_k[i], f.sun, f.sky, f.reflected,
        f.sky_longwave, f.ground_longwave, f.emitted, f.convection, f.latent, f.power, -f.sum());
  }
}

}  // namespace

std::vector<TemperatureReport::Crossover> crossovers_of(const TemperatureReport& report) {
  std::vector<TemperatureReport::Crossover> found;
  for (std::size_t a = 0; a < report.materials.size(); ++a)
    for (std::size_t b = a + 1; b < report.materials.size(); ++b) {
      const std::vector<double>&one = report.materials[a].sunlit.surface_k,
            &other = report.materials[b].sunlit.surface_k;
      for (std::size_t i = 1; i < report.time_s.size(); ++i) {
        const double before = one[i - 1] - other[i - 1], after = one[i] - other[i];
        if (before * after > 0.0 || after == 0.0 || before == after) continue;
        const double share = before / (before - after);
        found.push_back({report.time_s[i - 1] + share * (report.time_s[i] - report.time_s[i - 1]),
                         after > 0.0 ? a : b, after > 0.0 ? b : a});
      }
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return found;
}

std::string temperature_text(const TemperatureReport& report) {
  std::string text = format("{}: surfaces from {} to {}\n", report.document, utc_text(report.time_s.front()),
                            utc_text(report.time_s.back()));
  for (const std::string& note : report.notes) text += "  " + note + "\n";
  for (const TemperatureReport::Material& material : report.materials)
    text += material_table(report, material);
  return text + crossover_lines(report);
}

std::string temperature_csv(const TemperatureReport& report) {
  std::string text = format("# surface temperatures of {} by ifov\n", report.document);
  for (const std::string& note : report.notes) text += "# " + note + "\n";
  text +=
      "# fluxes in W m-2, positive where the surface gains them: sunlight absorbed (direct, of the sky, from the ground), long-wave\n"
      "# absorbed (of the sky, of the ground) and emitted, convection, latent heat, power from inside, conduction from the solid\n";
  for (const TemperatureReport::Material& material : report.materials)
    for (const std::string& line : material.description) text += format("# {}: {}\n", material.name, line);
  for (const TemperatureReport::Crossover& one : report.crossovers)
    text += format("# {}: '{}' becomes warmer than '{}'\n", utc_text(one.time_s),
                   report.materials[one.warmer].name, report.materials[one.cooler].name);
  text +=
      "material,light,time,air_k,surface_k,sun_w_m2,sky_w_m2,reflected_w_m2,sky_longwave_w_m2,ground_longwave_w_m2,"
      "emitted_w_m2,convection_w_m2,latent_w_m2,power_w_m2,conduction_w_m2\n";
  for (const TemperatureReport::Material& material : report.materials) {
    if (material.here) add_rows(text, report, material.name, "here", material.here->day);
    add_rows(text, report, material.name, "sunlit", material.sunlit);
    add_rows(text, report, material.name, "shaded", material.shaded);
  }
  return text;
}

}  // namespace ifov::io
