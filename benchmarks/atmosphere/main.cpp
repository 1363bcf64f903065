// What the modelled atmosphere costs. Prints one JSON object: processor seconds of two threads, halved, to
// build the tables of three sensors, peak memory, and the time of a path under it over that of the same path
// under a uniform sky.
//   bench_atmosphere FOLDER                the forest's files go there
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "core/format.h"
#include "io/document/document.h"
#include "radiometry/spectral_nodes.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/tile.h"
#include "scene/forest.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "studies/atmosphere/table_speed.h"

namespace {

using namespace ifov;
constexpr int kThreads = 2, kRounds = 5, kPixels = 256;

/// Processor seconds of all threads so far, in user mode: steadier than time where others use the machine.
double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// The forest of the speed benchmarks in spectra of the library, in this many channels of 10 nm.
std::string document(bool modelled, int channels) {
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
      "channels": [{{"name": "S", "series": {{"gaussian": {{"from": "400 nm", "to": "2500 nm", "count": {}, "fwhm": "10 nm"}}}}}}]}},
    "sampling": {{"single": {{}}}}}})",
      kGround[0], kGround[1], slots, air, sky, kPixels, kPixels, channels);
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
  const double before = user_seconds();
  render::render_image(session.parts().job(), control, sink);
  return (user_seconds() - before) / kThreads;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct PathCost {
  double ratio = 0.0;  ///< under the air over under a uniform sky
  double path_us = 0.0;
  std::size_t columns_air = 0, columns_sky = 0;
};

PathCost path_cost(const std::filesystem::path& folder, int channels) {
  const auto load = [&](bool modelled, const char* name) {
    return session::Session::load(io::parse_document(document(modelled, channels), (folder / name).string()),
                                  nullptr);
  };
  const session::Session under_air = load(true, "atmosphere.json"), under_sky = load(false, "sky.json");
  render_s(under_air);
  std::vector<double> ratios, seconds_air;
  for (int round = 0; round < kRounds; ++round) {
    const double air = render_s(under_air), sky = render_s(under_sky);
    ratios.push_back(air / sky);
    seconds_air.push_back(air);
  }
  return {median(ratios), 1e6 * median(seconds_air) / (static_cast<double>(kPixels) * kPixels),
          under_air.parts().nodes->node_count(), under_sky.parts().nodes->node_count()};
}

void run(const std::filesystem::path& folder) {
  const studies::TableSpeed solar = studies::time_tables(studies::timed_vswir(), kThreads),
                            thermal = studies::time_tables(studies::timed_thermal(), kThreads),
                            few = studies::time_tables(studies::timed_multispectral(), kThreads);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double peak_gib = static_cast<double>(usage.ru_maxrss) / (1 << 20);
  benchmarks::write_forest(folder);
  const PathCost many = path_cost(folder, 210), ten = path_cost(folder, 10);
  std::puts(
      format(
          R"({{"vswir_s": {}, "vswir_nodes": {}, "thermal_s": {}, "multispectral_s": {}, "right": {}, "peak_gib": {}, )"
          R"("path_over_sky": {}, "path_over_sky_10": {}, "path_us": {}, "columns_air": {}, "columns_sky": {}}})",
          solar.cpu_seconds / kThreads, solar.nodes, thermal.cpu_seconds / kThreads,
          few.cpu_seconds / kThreads, solar.right && thermal.right && few.right, peak_gib, many.ratio,
          ten.ratio, many.path_us, many.columns_air, many.columns_sky)
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
