#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/thermal_document.h"
#include "io/temperature_report/temperature_report.h"
#include "studies/common/study_document.h"
#include "studies/temperature/solved_documents.h"
#include "studies/temperature/temperature_sections.h"

namespace ifov::studies {
namespace {

io::MaterialDocument day_material(const char* name, std::vector<io::ThermalLayerDocument> layers,
                                  double absorptance, bool on_ground, bool grass = false) {
  io::MaterialDocument material = grey(name, 0.05);
  auto thermal = std::make_shared<io::ThermalDocument>();
  thermal->layers = std::move(layers);
  if (on_ground) thermal->back.ground = {285.15};
  thermal->solar_absorptance = absorptance;
  if (grass) {
    thermal->wetness = 1.0;
    thermal->resistance_s_m = 70.0;
    thermal->roughness = "very rough";
  }
  material.thermal = std::move(thermal);
  return material;
}

/// The hour at which one becomes warmer than the other between two hours; not a number: it does not.
double crossover_hour(const io::TemperatureReport& report, std::size_t warmer, std::size_t cooler,
                      double from_h, double to_h) {
  for (const auto& one : report.crossovers) {
    const double hour = 24.0 + (one.time_s - report.time_s.back()) / 3600.0;
    if (one.warmer == warmer && one.cooler == cooler && hour >= from_h && hour <= to_h) return hour;
  }
  return NAN;
}

void add_crossovers(const SectionOptions& options, ReportSection& section) {
  io::Document document = solved_document(write_june(options.study), "15:00", 300.0);
  document.time = geodesy::parse_utc("2026-06-22T00:00:00Z");
  enum { road, lawn, roof, car };
  document.scene.materials = {
      day_material("road", {{0.06, "asphalt"}, {0.3, "gravel"}, {1.0, "dry soil"}}, 0.9, true),
      day_material("lawn", {{1.0, "moist soil"}}, 0.77, true, true),
      day_material("roof", {{0.015, "concrete tile"}, {0.2, "insulation"}}, 0.85, false),
      day_material("car", {{0.001, "steel"}}, 0.85, false)};
  document.scene.objects = {solved_ground()};
  const io::TemperatureReport report = surveyed_day(document, "day", options.study);
  double dawn_h[4], dusk_h[4];
  for (const std::size_t one : {roof, car}) {
    const std::string& name = document.scene.materials[one].name;
    dawn_h[one] = crossover_hour(report, one, road, 3.0, 12.0);
    dusk_h[one] = crossover_hour(report, road, one, 12.0, 23.0);
    section.figures.between(format("dawn_{}", name), dawn_h[one], 3.0, 12.0, "h",
                            format("{} becomes warmer than the road, UTC", name));
    section.figures.between(format("dusk_{}", name), dusk_h[one], 12.0, 23.0, "h",
                            format("{} becomes cooler than the road, UTC", name));
  }
  section.figures.at_least("dawn_order", dawn_h[roof] - dawn_h[car], 0.0, "h",
                           "the car, which holds least heat, before the roof in the morning, by");
  section.figures.at_least("dusk_order", dusk_h[roof] - dusk_h[car], 0.0, "h", "and in the evening, by");
  const auto warmest_k = [&](std::size_t of) {
    return *std::max_element(report.materials[of].sunlit.surface_k.begin(),
                             report.materials[of].sunlit.surface_k.end());
  };
  section.figures.at_least("lawn_cooler", warmest_k(road) - warmest_k(lawn), 5.0, "K",
                           "a lawn that gives off water is cooler than the road at its warmest, by");
  Plot plot;
  plot.title = "A day of June";
  plot.x_label = "hour, UTC";
  plot.y_label = "temperature in the Sun, K";
  constexpr const char* kColours[] = {"#000000", "#009e73", "#d55e00", "#0072b2"};
  for (std::size_t k = 0; k < report.materials.size(); ++k) {
    PlotSeries curve{report.materials[k].name, kColours[k], {}, report.materials[k].sunlit.surface_k, false};
    for (const double time_s : report.time_s)
      curve.x.push_back(24.0 + (time_s - report.time_s.back()) / 3600.0);
    plot.series.push_back(std::move(curve));
  }
  section.plots.push_back({"crossovers", plot, "Road, lawn, roof and car, solved by the program."});
}

void add_alamosa(const SectionOptions& options, ReportSection& section) {
  const auto file = options.reference.file("weather/surfrad_alamosa_2016-01-01_forcing.csv");
  if (!file) return section.not_measured("alamosa", "bare soil under a measured day", "reference data");
  io::Document document = solved_document("june.csv", "15:00", 300.0);
  document.time = geodesy::parse_utc("2016-01-01T23:59:00Z");
  constexpr double kDegree = 0.017453292519943295;
  document.scene.origin.geographic = {37.70 * kDegree, -105.92 * kDegree};
  document.scene.origin.height_m = 2317.0;
  document.weather->source = {
      io::DocumentFile{std::filesystem::absolute(*file).string(), {}}, "2016-01-01", {}};
  io::MaterialDocument soil = grey("road", 0.1);
  soil.spectrum.source = io::LibrarySource{"soil, bare", 0};
  document.scene.materials = {std::move(soil)};
  document.scene.objects = {solved_ground()};
  const io::TemperatureReport report = surveyed_day(document, "alamosa", options.study);
  const io::TemperatureReport::Day& day = report.materials.front().sunlit;
  Plot plot;
  plot.title = "A measured day";
  plot.x_label = "hour, UTC";
  plot.y_label = "temperature, K";
  PlotSeries skin{"soil, solved", "#d55e00", {}, day.surface_k, false},
      air{"air, measured", "#0072b2", {}, report.air_k, false};
  Plot fluxes;
  fluxes.title = "Its fluxes";
  fluxes.x_label = "hour, UTC";
  fluxes.y_label = "gained by the surface, W/m^2";
  PlotSeries sun{"sunlight", "#e69f00", {}, {}, false}, longwave{"long-wave, net", "#d55e00", {}, {}, false},
      convection{"air", "#0072b2", {}, {}, false}, ground{"ground", "#000000", {}, {}, false};
  double worst = 0.0;
  for (std::size_t k = 0; k < report.time_s.size(); ++k) {
    const thermal::Fluxes& now = day.fluxes[k];
    const double hour = 23.0 + 59.0 / 60.0 + (report.time_s[k] - report.time_s.back()) / 3600.0;
    for (PlotSeries* series : {&skin, &air, &sun, &longwave, &convection, &ground}) series->x.push_back(hour);
    sun.y.push_back(now.sun + now.sky + now.reflected);
    longwave.y.push_back(now.sky_longwave + now.ground_longwave + now.emitted);
    convection.y.push_back(now.convection);
    ground.y.push_back(-now.sum());
    worst = std::max(worst, std::abs(report.materials.front().unaccounted));
    const double nearest = std::round(hour);
    if (std::abs(hour - nearest) < 0.03 && nearest >= 0.0 && nearest < 24.0)
      section.figures.report(format("alamosa_{:02d}_h", static_cast<int>(nearest)), day.surface_k[k] - 273.15,
                             "degC",
                             format("bare dry soil at Alamosa, {} h UTC (air {:.1f} degC)",
                                    static_cast<int>(nearest), report.air_k[k] - 273.15));
  }
  section.figures.at_most("alamosa_unaccounted", worst, 1e-6, "",
                          "heat of that day that is not accounted for, over what came in");
  plot.series = {skin, air};
  fluxes.series = {sun, longwave, convection, ground};
  section.plots.push_back(
      {"alamosa", plot,
       "Bare soil of the library at SURFRAD's Alamosa on 2016-01-01: tables alone, nothing fitted."});
  section.plots.push_back({"alamosa_fluxes", fluxes, "What its surface gains."});
}

}  // namespace

ReportSection measured_day_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Days";
  section.text =
      "When road, lawn, roof and car are warmer than each other over a clear day, as `ifov temperature` tells; and the skin of bare soil, hour by hour, "
      "under a day that was measured. What that soil sent up is not in the file, so that nothing is asked of it.";
  add_crossovers(options, section);
  add_alamosa(options, section);
  return section;
}

}  // namespace ifov::studies
