#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/rfmip_fluxes.h"

namespace ifov::studies {

AtmosphereSection broadband_section(const SectionOptions& options) {
  AtmosphereSection section;
  section.title = "Broadband fluxes";
  section.text =
      "Clear columns of RFMIP (Pincus et al. 2016), experiment 0: fluxes down to the ground against "
      "RTE+RRTMGP. Below 200 cm-1, where the band model ends, the air counts as opaque, which is too bright "
      "over "
      "dry cold ground. Sunlight is solved in flat layers, as the reference has it, every 25 cm-1 from 0.2 "
      "to 10 "
      "um, for columns whose Sun is at least 5 degrees high. What is left of the difference there grows with "
      "the "
      "water vapour that the beam crosses, from nothing in dry columns: the lines of water at 0.82 and 0.94 "
      "um are "
      "too weak in LOWTRAN7 itself, as its own output for the moist path above shows.";
  const std::string name = "atmosphere/rrtmgp_rfmip";
  const auto folder = options.reference.file(name);
  if (!folder) {
    section.not_measured("rfmip_longwave", "RFMIP fluxes", name);
    return section;
  }
  std::vector<std::size_t> sites;
  for (std::size_t site = 0; site < 100; site += options.study.is_quick() ? 20 : 1) sites.push_back(site);
  Differences longwave;
  double sun = 0.0, sun_reference = 0.0, worst = 0.0, worst_drier = 0.0;
  int within = 0, longwave_held = 0, shortwave_held = 0;
  std::vector<double> longwave_stated, shortwave_stated;
  constexpr double kMuchWater_g_cm2 = 10.0;
  PlotSeries down{"long-wave", "#0072b2", {}, {}, true}, lit{"short-wave", "#d55e00", {}, {}, true};
  for (const RfmipColumn& column : rfmip_fluxes(*folder, sites, {.threads = options.study.threads})) {
    longwave.add(column.longwave, column.longwave_reference);
    longwave_held += std::abs(column.longwave - column.longwave_reference) <= column.longwave_stated;
    longwave_stated.push_back(column.longwave_stated);
    down.x.push_back(column.longwave_reference);
    down.y.push_back(column.longwave - column.longwave_reference);
    if (column.shortwave_reference <= 0.0) continue;
    sun += column.shortwave;
    sun_reference += column.shortwave_reference;
    const double off = std::abs(column.shortwave / column.shortwave_reference - 1.0);
    worst = std::max(worst, off);
    if (off <= 0.02) ++within;
    shortwave_held += std::abs(column.shortwave - column.shortwave_reference) <= column.shortwave_stated;
    shortwave_stated.push_back(100.0 * column.shortwave_stated / column.shortwave_reference);
    if (column.water_in_beam_g_cm2 < kMuchWater_g_cm2) worst_drier = std::max(worst_drier, off);
    lit.x.push_back(column.shortwave_reference);
    lit.y.push_back(column.shortwave - column.shortwave_reference);
  }
  section.figures.at_most("rfmip_longwave", std::abs(longwave.mean()), 6.0, "W m-2",
                          format("long-wave flux down, {} columns: mean difference", longwave.count()));
  section.figures.at_most("rfmip_longwave_rms", longwave.rms(), 6.0, "W m-2", "the same, rms");
  section.figures.report("rfmip_longwave_largest", longwave.largest(), "W m-2", "the same, largest");
  section.figures.at_most("rfmip_shortwave", 100.0 * std::abs(sun / sun_reference - 1.0), 2.0, "%",
                          format("short-wave flux down, {} columns: difference of the sums", lit.x.size()));
  section.figures.report("rfmip_shortwave_within", within, "",
                         format("columns of these {} within 2 %", lit.x.size()));
  section.figures.at_most("rfmip_shortwave_largest", 100.0 * worst, 2.0, "%",
                          "the same, largest difference of a column");
  section.figures.at_most("rfmip_shortwave_drier", 100.0 * worst_drier, 2.0, "%",
                          format("where the beam crosses less than {:g} g cm-2 of water", kMuchWater_g_cm2));
  const auto median = [](std::vector<double>& values) {
    if (values.empty()) return 0.0;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
  };
  section.figures.at_least("rfmip_longwave_held",
                           static_cast<double>(longwave_held) / static_cast<double>(longwave.count()), 0.9,
                           "", "share of the long-wave fluxes that the stated error of the model holds");
  section.figures.report("rfmip_longwave_stated", median(longwave_stated), "W m-2",
                         "how wide that is, median");
  if (!shortwave_stated.empty()) {
    section.figures.at_least("rfmip_shortwave_held",
                             static_cast<double>(shortwave_held) / static_cast<double>(lit.x.size()), 0.9, "",
                             "share of the short-wave fluxes that it holds");
    section.figures.report("rfmip_shortwave_stated", median(shortwave_stated), "%",
                           "how wide that is, median");
  }
  Plot plot;
  plot.title = "Fluxes down to the ground, ifov less RTE+RRTMGP";
  plot.x_label = "flux, W m-2";
  plot.y_label = "difference, W m-2";
  plot.y_low = -12.0;
  plot.y_high = 16.0;
  plot.levels = {{"", "#888", 0.0, 0.0}};
  plot.series = {down, lit};
  section.plots.push_back({"rfmip", plot, "One point a column."});
  return section;
}

}  // namespace ifov::studies
