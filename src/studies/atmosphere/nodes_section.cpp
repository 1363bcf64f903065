#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "atmosphere/sensor/channel_light.h"
#include "core/error.h"
#include "core/format.h"
#include "io/library/material_library.h"
#include "io/spectra/channel_table.h"
#include "radiometry/planck.h"
#include "radiometry/solar_spectrum.h"
#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/node_errors.h"

namespace ifov::studies {
namespace {

constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};

/// Worst of the surfaces, at the channel nearest to a wavelength.
double worst_at(const NodeErrors& errors, double wavelength_um) {
  std::size_t nearest = 0;
  for (std::size_t c = 0; c < errors.centre_um.size(); ++c)
    if (std::abs(errors.centre_um[c] - wavelength_um) < std::abs(errors.centre_um[nearest] - wavelength_um))
      nearest = c;
  double worst = 0.0;
  for (const auto& by_channel : errors.relative) worst = std::max(worst, std::abs(by_channel[nearest]));
  return worst;
}

double worst_of(const NodeErrors& errors) {
  double worst = 0.0;
  for (const auto& by_channel : errors.relative)
    for (const double error : by_channel) worst = std::max(worst, std::abs(error));
  return worst;
}

}  // namespace

AtmosphereSection nodes_section(const SectionOptions& options) {
  AtmosphereSection section;
  section.title = "Spectral nodes";
  section.text =
      "The renderer carries at most 8 nodes a channel. Here the radiance at the sensor over endless "
      "Lambertian ground "
      "(reflectance 0.05, 0.2, 0.5 and green grass), Sun 40 degrees from the zenith, view 10 degrees off the "
      "nadir, "
      "mid-latitude summer, 23 km visibility, is compared with a solution of every bin of 5 cm-1 and every "
      "absorption "
      "term. Both sides use the scattering solver with 4 zenith angles and without polarization, which makes "
      "thousands of solutions affordable; what is judged is how well the nodes stand for all terms.";
  std::vector<radiometry::Channel> vswir;
  const int step = options.study.is_quick() ? 14 : 1;
  for (int k = 0; k < 210; k += step)
    vswir.push_back(radiometry::Channel::gaussian("", 0.4 + 2.1 * k / 209.0, 0.01));
  const NodeErrors errors = node_errors(vswir, {.threads = options.study.threads});
  section.figures.at_most(
      "nodes_vswir", 100.0 * worst_of(errors), 0.5, "%",
      format("{} channels of 10 nm, 0.4 to 2.5 um, four surfaces: largest error", vswir.size()));
  section.figures.report("nodes_per_channel",
                         static_cast<double>(errors.nodes) / static_cast<double>(vswir.size()), "",
                         "nodes a channel, on average");
  for (const double um : {0.94, 1.38})
    section.figures.at_most(format("nodes_{:.0f}nm", 1e3 * um), 100.0 * worst_at(errors, um), 0.5, "%",
                            format("the channel at {:g} um", um));
  Plot plot;
  plot.title = "Nodes against all bins and terms";
  plot.x_label = "wavelength, um";
  plot.y_label = "error of radiance at the sensor, %";
  plot.y_low = -0.6;
  plot.y_high = 0.8;
  plot.levels = {{"allowed", "#888", 0.0, 0.5}};
  for (std::size_t s = 0; s < errors.relative.size(); ++s) {
    PlotSeries series{errors.surfaces[s], kColours[s % 4], errors.centre_um, {}};
    for (const double error : errors.relative[s]) series.y.push_back(100.0 * error);
    plot.series.push_back(std::move(series));
  }
  section.plots.push_back({"nodes_vswir", plot,
                           "210 channels of 10 nm. The bands at 1.38 and 1.88 um show path radiance alone."});

  const std::vector<radiometry::Channel> deep = {radiometry::Channel::gaussian("", 2.7, 0.06)};
  section.figures.at_most("nodes_2700nm",
                          100.0 * worst_of(node_errors(deep, {.threads = options.study.threads})), 0.5, "%",
                          "a channel of 60 nm at 2.7 um, where hardly any light passes");
  for (const auto& [key, name] : {std::pair{"oli", "L8_OLI"}, {"tirs", "L8_TIRS"}}) {
    const std::string path = format("sensors/rsr-acolite/{}.txt", name);
    const auto file = options.reference.file(path);
    if (!file) {
      section.not_measured(format("nodes_{}", key), format("channels of {}", name), path);
      continue;
    }
    const std::vector<radiometry::Channel> channels = io::read_channels(*file);
    section.figures.at_most(
        format("nodes_{}", key), 100.0 * worst_of(node_errors(channels, {.threads = options.study.threads})),
        0.5, "%", format("Landsat 8, {} channels of {}: largest error", channels.size(), name));
  }
  return section;
}

}  // namespace ifov::studies
