// What the modelled atmosphere costs. Prints one JSON object: seconds to build the tables of three sensors on
// two threads, peak memory, and the time of a path under it over that of the same path under a uniform sky.
//   bench_atmosphere
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

#include "atmosphere/sensor/channel_light.h"
#include "core/format.h"
#include "io/document/document.h"
#include "io/library/material_library.h"
#include "radiometry/solar_spectrum.h"
#include "session/parts.h"

namespace {

using namespace ifov;
constexpr int kThreads = 2, kRounds = 5;

double seconds(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<radiometry::Channel> gaussians(int count, double first_um, double last_um, double width_um) {
  std::vector<radiometry::Channel> channels;
  for (int k = 0; k < count; ++k)
    channels.push_back(
        radiometry::Channel::gaussian("", first_um + (last_um - first_um) * k / (count - 1.0), width_um));
  return channels;
}

/// The nine reflective channels of Landsat 8, as rectangles.
std::vector<radiometry::Channel> multispectral() {
  std::vector<radiometry::Channel> channels;
  for (const auto& [first, last] : {std::pair{0.435, 0.451},
                                    {0.452, 0.512},
                                    {0.533, 0.590},
                                    {0.636, 0.673},
                                    {0.851, 0.879},
                                    {1.566, 1.651},
                                    {2.107, 2.294},
                                    {0.503, 0.676},
                                    {1.363, 1.384}})
    channels.push_back(radiometry::Channel::top_hat("", first, last));
  return channels;
}

struct Tables {
  double seconds = 0.0;
  std::size_t nodes = 0;
  bool right = true;
};

/// The first channel is checked against all of its bins and terms: tables that are wrong are not fast.
Tables build(const std::vector<radiometry::Channel>& channels) {
  const radiometry::Spectrum surfaces[] = {io::material_library().find("grass, lawn").curves[0].reflectance,
                                           io::material_library().find("asphalt, black").curves[0].reflectance};
  atmosphere::SensorAtmosphere::Inputs inputs;
  inputs.channels = channels;
  inputs.solar_irradiance = radiometry::solar_irradiance_1au();
  inputs.surfaces = surfaces;
  inputs.demands.tolerance = 5e-3;
  inputs.demands.most_nodes = 8;
  const bool warm = channels.front().centre_um > 2.5;
  inputs.demands.coldest_k = warm ? 260.0 : 0.0;
  inputs.demands.hottest_k = warm ? 340.0 : 0.0;
  inputs.geometry.sun_zenith_rad = 40.0 * std::numbers::pi / 180.0;
  inputs.threads = kThreads;
  const auto start = std::chrono::steady_clock::now();
  const atmosphere::AtmosphereColumn column{atmosphere::AtmosphereDescription{}};
  const atmosphere::SensorAtmosphere air(column, inputs);
  Tables tables{seconds(start), air.node_count(), true};
  const auto all =
      atmosphere::solve_all_terms(column, channels.front(), inputs.solar_irradiance, inputs.geometry);
  const auto nodes = atmosphere::channel_nodes(air, 0);
  const std::vector<double> at_all(all.size(), 0.2), at_nodes(nodes.size(), 0.2);
  const double expected = atmosphere::lambertian_radiance(all, inputs.geometry, at_all);
  const double found = atmosphere::lambertian_radiance(nodes, inputs.geometry, at_nodes);
  tables.right = std::abs(found / expected - 1.0) < 0.005;
  return tables;
}

/// Blocks on grass, in 210 channels of 10 nm.
std::string document(bool modelled) {
  std::string objects = R"({"plane": {}, "material": "grass"})";
  for (int k = 0; k < 40; ++k) {
    const double x = -60.0 + 17.0 * (k % 8), y = -50.0 + 21.0 * (k / 8), high = 4.0 + (k * 7 % 5);
    objects += format(
        R"(, {{"box": {{"low": ["{} m", "{} m", "0 m"], "high": ["{} m", "{} m", "{} m"]}}, "material": "road"}})",
        x, y, x + 8.0, y + 11.0, high);
  }
  const std::string light = modelled ? R"("atmosphere": {"profile": "mid-latitude summer"},)" : "";
  const std::string sky = modelled ? "" : R"("sky": {"radiance": "50 W m-2 sr-1 um-1"},)";
  return format(R"({{"ifov": 1, "scene": {{"materials": {{
      "grass": {{"reflectance": {{"library": "grass, lawn"}}}}, "road": {{"reflectance": {{"library": "asphalt, black"}}}}}},
    "objects": [{}]}}, {}
    "light": {{{} "sun": {{"disc": {{"zenith": "40 deg", "azimuth": "150 deg"}}}}}},
    "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [128, 128], "center": ["0 m", "0 m"]}}}},
      "channels": [{{"name": "S", "series": {{"gaussian": {{"from": "400 nm", "to": "2500 nm", "count": 210, "fwhm": "10 nm"}}}}}}]}},
    "sampling": {{"grid": {{"elements": [4, 4]}}}}}})",
                objects, light, sky);
}

class NoSink final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult&) override {}
};

double render_s(const session::Session& session) {
  NoSink sink;
  render::RenderControl control;
  control.threads = kThreads;
  const auto start = std::chrono::steady_clock::now();
  render::render_image(session.parts().job(), control, sink);
  return seconds(start);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void run() {
  const Tables solar = build(gaussians(210, 0.4, 2.5, 0.01)), thermal = build(gaussians(10, 8.2, 12.25, 0.4)),
               few = build(multispectral());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double peak_gib = static_cast<double>(usage.ru_maxrss) / (1 << 20);
  const session::Session under_air =
      session::Session::load(io::parse_document(document(true), "atmosphere.json"), nullptr);
  const session::Session under_sky =
      session::Session::load(io::parse_document(document(false), "sky.json"), nullptr);
  render_s(under_air);
  std::vector<double> ratios, seconds_air;
  for (int round = 0; round < kRounds; ++round) {
    const double air = render_s(under_air), sky = render_s(under_sky);
    ratios.push_back(air / sky);
    seconds_air.push_back(air);
  }
  std::puts(
      format(
          R"({{"vswir_s": {}, "vswir_nodes": {}, "thermal_s": {}, "multispectral_s": {}, "right": {}, "peak_gib": {}, )"
          R"("path_over_sky": {}, "path_us": {}, "columns_air": {}, "columns_sky": {}}})",
          solar.seconds, solar.nodes, thermal.seconds, few.seconds, solar.right && thermal.right && few.right,
          peak_gib, median(ratios), 1e6 * median(seconds_air) / (128.0 * 128.0 * 16.0),
          under_air.parts().nodes->node_count(), under_sky.parts().nodes->node_count())
          .c_str());
}

}  // namespace

int main() {
  try {
    run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
