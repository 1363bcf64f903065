#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/shapes/flat_primitives.h"
#include "io/files/input_file.h"
#include "io/spectra/channel_table.h"
#include "radiometry/planck.h"
#include "studies/common/image_store.h"
#include "studies/common/study_document.h"
#include "studies/common/study_rendering.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {
namespace {

constexpr const char* kTirs = "sensors/rsr-acolite/L8_TIRS.txt";
constexpr const char* kMtl = "thermal_radiometry/landsat-mtl/LC81060712016134LGN00_MTL.txt";

/// Mean of Planck's law over a response, two points of Gauss in every step of its table.
double mean_planck(const radiometry::Channel& channel, double kelvin) {
  const auto um = channel.response.wavelength_um();
  const auto value = channel.response.values();
  double total = 0.0, weights = 0.0;
  for (std::size_t k = 0; k + 1 < um.size(); ++k)
    for (const double side : {-1.0, 1.0}) {
      const double share = 0.5 + 0.5 * side / std::sqrt(3.0), step = um[k + 1] - um[k];
      const double below = std::max(0.0, static_cast<double>(value[k])),
                   above = std::max(0.0, static_cast<double>(value[k + 1]));
      const double weight = step * (below + share * (above - below));
      total += weight * radiometry::planck_w_m2_sr_um(um[k] + share * step, kelvin);
      weights += weight;
    }
  return total / weights;
}

double kelvin_of(const radiometry::Channel& channel, double radiance) {
  double low = 150.0, high = 500.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (mean_planck(channel, middle) < radiance ? low : high) = middle;
  }
  return low;
}

double constant(const std::string& mtl, const std::string& name) {
  std::smatch found;
  if (!std::regex_search(mtl, found, std::regex(name + " = ([0-9.]+)"))) return std::nan("");
  return std::stod(found[1]);
}

}  // namespace

ReportSection tirs_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "A blackbody through TIRS";
  section.text =
      "Black ground of 240 to 340 K, rendered through the responses of Landsat 8 TIRS bands 10 and 11, and back to kelvins in both ways: by "
      "the constants K1 and K2 that the products come with, T = K2 / ln(K1/L + 1), and by the response itself. Two constants stand for one "
      "wavelength, so that the first way is off by what the width of the band does.";
  const auto responses = options.reference.file(kTirs), mtl_file = options.reference.file(kMtl);
  if (!responses || !mtl_file) {
    section.not_measured("tirs_10_300", "a blackbody through TIRS", responses ? kMtl : kTirs);
    return section;
  }
  const std::string mtl = io::read_input(*mtl_file);
  const std::vector<radiometry::Channel> channels = io::read_channels(*responses);
  Plot plot;
  plot.title = "Kelvins by two constants instead of the response";
  plot.x_label = "temperature of the ground, K";
  plot.y_label = "error of the temperature, K";
  const std::array<const char*, 2> names{"10", "11"};
  const std::array<const char*, 2> colours{"#0072b2", "#d55e00"};
  std::array<std::vector<double>, 2> seen;
  std::vector<double> temperatures;
  for (double kelvin = 240.0; kelvin <= 340.0; kelvin += 10.0) {
    io::Document document =
        nadir_document(nadir_camera(1, 1, 0.0, 1.0), "", 10.0, single_sampling(), options.study.seed);
    document.sensor.channels.clear();
    for (const char* name : names)
      document.sensor.channels.push_back(
          {name,
           io::TabulatedChannel{{std::filesystem::absolute(*responses).string(), {}}, 1e-3, 2, name},
           {},
           {},
           {}});
    document.scene.materials = {black("ground", {kelvin, {}})};
    document.scene.objects = {object_of(io::PlanePrimitive(), "ground")};
    ImageStore image;
    render_document(study_text(document), options.study.output_folder, {}, image);
    temperatures.push_back(kelvin);
    for (std::size_t b = 0; b < 2; ++b) seen[b].push_back(static_cast<double>(image.mean()[b]));
  }
  for (std::size_t b = 0; b < 2; ++b) {
    const double k1 = constant(mtl, format("K1_CONSTANT_BAND_{}", names[b])),
                 k2 = constant(mtl, format("K2_CONSTANT_BAND_{}", names[b]));
    const auto channel =
        std::find_if(channels.begin(), channels.end(), [&](const auto& c) { return c.name == names[b]; });
    if (channel == channels.end()) continue;
    PlotSeries two{format("band {}, K1 and K2", names[b]), colours[b], {}, {}, false},
        whole{format("band {}, response", names[b]), colours[b], {}, {}, true};
    for (std::size_t k = 0; k < temperatures.size(); ++k) {
      const double kelvin = temperatures[k], radiance = seen[b][k];
      const double by_constants = k2 / std::log(k1 / radiance + 1.0),
                   by_response = kelvin_of(*channel, radiance);
      two.x.push_back(kelvin), two.y.push_back(by_constants - kelvin);
      whole.x.push_back(kelvin), whole.y.push_back(by_response - kelvin);
      section.figures.between(
          format("tirs_{}_{:g}", names[b], kelvin), by_response - kelvin, -1e-3, 1e-3, "K",
          format(
              "band {}, {:g} K: {:.5f} W m-2 sr-1 um-1, by K1 and K2 {:.3f} K, by the response {:.4f} K: error of the latter",
              names[b], kelvin, radiance, by_constants, by_response));
    }
    plot.series.push_back(two);
    plot.series.push_back(whole);
  }
  section.plots.push_back(
      {"tirs", plot, "Points: by the response. Lines: by K1 and K2 of LC81060712016134LGN00."});
  return section;
}

}  // namespace ifov::studies
