// What the modelled atmosphere costs. Prints one JSON object: seconds to build the tables of three sensors on
// two threads, peak memory, and the time of a path under it over that of the same path under a uniform sky.
//   bench_atmosphere FOLDER                the forest's files go there
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "atmosphere/sensor/channel_light.h"
#include "core/format.h"
#include "io/document/document.h"
#include "io/library/material_library.h"
#include "radiometry/solar_spectrum.h"
#include "scene/forest.h"
#include "session/parts.h"

namespace {

using namespace ifov;
constexpr int kThreads = 2, kRounds = 5, kPixels = 256;

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
  const radiometry::Spectrum surfaces[] = {
      io::material_library().find("grass, lawn").curves[0].reflectance,
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

/// The forest of the speed benchmarks in spectra of the library, in 210 channels of 10 nm.
std::string document(bool modelled) {
  constexpr const char* kGround[] = {"grass, lawn", "asphalt, black"};
  std::string slots;
  for (int m = 0; m < benchmarks::kForestGroundMaterials; ++m)
    slots += format(R"({}"ground{}": "ground{}")", m > 0 ? ", " : "", m, m % 2);
  const std::string air = modelled ? R"("atmosphere": {"profile": "mid-latitude summer"},)" : "";
  const std::string sky = modelled ? "" : R"("sky": {"radiance": "50 W m-2 sr-1 um-1"},)";
  return format(
      R"({{"ifov": 1, "scene": {{"materials": {{
      "ground0": {{"reflectance": {{"library": "{}"}}}}, "ground1": {{"reflectance": {{"library": "{}"}}}},
      "leaf": {{"reflectance": {{"library": "grass, lawn"}}}}}},
    "prototypes": {{"tree": [{{"mesh": {{"file": "tree.obj"}}, "material": {{"slots": {{"tree0": "leaf", "tree1": "ground1"}}}}}}]}},
    "objects": [{{"mesh": {{"file": "terrain.obj"}}, "material": {{"slots": {{{}}}}}}},
                {{"instances": {{"of": "tree", "csv": "trees.csv"}}}}]}}, {}
    "light": {{{} "sun": {{"disc": {{"zenith": "40 deg", "azimuth": "150 deg"}}}}}},
    "sensor": {{"camera": {{"orthographic": {{"gsd": "3.83 m", "pixels": [{}, {}]}}}},
      "channels": [{{"name": "S", "series": {{"gaussian": {{"from": "400 nm", "to": "2500 nm", "count": 210, "fwhm": "10 nm"}}}}}}]}},
    "sampling": {{"single": {{}}}}}})",
      kGround[0], kGround[1], slots, air, sky, kPixels, kPixels);
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

void run(const std::filesystem::path& folder) {
  const Tables solar = build(gaussians(210, 0.4, 2.5, 0.01)), thermal = build(gaussians(10, 8.2, 12.25, 0.4)),
               few = build(multispectral());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double peak_gib = static_cast<double>(usage.ru_maxrss) / (1 << 20);
  benchmarks::write_forest(folder);
  const session::Session under_air = session::Session::load(
      io::parse_document(document(true), (folder / "atmosphere.json").string()), nullptr);
  const session::Session under_sky =
      session::Session::load(io::parse_document(document(false), (folder / "sky.json").string()), nullptr);
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
          peak_gib, median(ratios), 1e6 * median(seconds_air) / (static_cast<double>(kPixels) * kPixels),
          under_air.parts().nodes->node_count(), under_sky.parts().nodes->node_count())
          .c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: bench_atmosphere FOLDER\n");
    return 2;
  }
  try {
    run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
