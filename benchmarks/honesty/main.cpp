// Are the intervals honest on real 3-D scenes? Each scene's mixed pixels, many seeds, against a plain path
// tracer.
//   bench_honesty --output figures.json --work FOLDER [--seeds N] [--first-seed N] [--only SCENE] [--rows FOLDER]
// Scenes must keep their promises; runs with a planted fault must break one of them.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "core/format.h"
#include "honesty/scene_run.h"

namespace {

using namespace ifov::benchmarks;

struct Row {
  std::string name, value, unit, must;
  bool ok = false;
};

std::string name_of(const HonestyCase& which) { return which.scene + (which.psf ? "_psf" : ""); }

std::string faults_of(const HonestyOutcome& outcome) {
  std::string text;
  for (std::size_t c = 0; c < outcome.honesty.size(); ++c)
    if (const std::string fault = outcome.honesty[c].fault(); !fault.empty())
      text += (text.empty() ? "" : "; ") + outcome.channels[c] + ": " + fault;
  return text;
}

void print_details(const HonestyCase& which, const HonestyOutcome& outcome) {
  for (std::size_t c = 0; c < outcome.honesty.size(); ++c) {
    const ChannelHonesty& h = outcome.honesty[c];
    std::printf(
        "    %-20s %-9s coverage %.4f  |z|>4 %.3f %%  half-width/RMS %.2f  bias %+5.1f se  sigma geometry "
        "%.3g paths %.3g"
        "  reference %.2f of half-width  small misses %lld\n",
        c == 0 ? name_of(which).c_str() : "", outcome.channels[c].c_str(), h.coverage, 100.0 * h.beyond_four,
        h.half_width_to_rms, h.bias, h.geometric_sigma, h.path_sigma, h.reference_to_half_width,
        static_cast<long long>(h.small_misses));
  }
  std::printf("    %-20s %zu pixels, %.0f samples a pixel of which %.0f paths\n", "", outcome.pixels,
              outcome.samples_per_pixel, outcome.paths_per_pixel);
  std::fflush(stdout);
}

/// The figure of an honest scene: the coverage farthest from 0.95 of its channels.
Row judged(const HonestyCase& which, const HonestyOutcome& outcome) {
  double worst = 0.95;
  for (const ChannelHonesty& h : outcome.honesty)
    if (std::abs(h.coverage - 0.95) >= std::abs(worst - 0.95)) worst = h.coverage;
  const std::string fault = faults_of(outcome);
  return {name_of(which), ifov::format("{:.5f}", worst), "coverage", fault.empty() ? "0.93 to 0.995" : fault,
          fault.empty()};
}

/// 1 where a planted fault breaks a promise and the same scene without it keeps all of them.
Row caught(const std::string& name, const HonestyOutcome& faulty, const HonestyOutcome& sound) {
  const std::string fault = faults_of(sound);
  const bool ok = fault.empty() && !faults_of(faulty).empty();
  return {name, ok ? "1" : "0", "caught", fault.empty() ? "1" : "1, but without the fault " + fault, ok};
}

/// Each on a scene where the mechanism that is switched off has to do the work, at that scene's own tolerance.
std::vector<std::pair<std::string, HonestyCase>> planted_faults(int seeds, std::uint64_t first_seed) {
  HonestyCase no_sun_state{"fences", false, false, {}, seeds, first_seed, {}};
  HonestyCase certain_singles{"patchwork", false, true, {}, seeds, first_seed, {}};
  certain_singles.faults.zero_variance_single_samples = true;
  HonestyCase undithered{"aligned_edge", false, true, {}, 10 * seeds, first_seed, {}};
  undithered.faults.undithered_brackets = true;
  return {{"fault_no_sun_state", no_sun_state},
          {"fault_certain_single_samples", certain_singles},
          {"fault_undithered_brackets", undithered}};
}

std::string json(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows)
    text += ifov::format(R"({}"{}": {{"value": {}, "unit": "{}", "must": "{}", "ok": {}}})",
                         text.empty() ? "" : ",\n ", row.name, row.value, row.unit, row.must,
                         row.ok ? "true" : "false");
  return "{" + text + "}\n";
}

}  // namespace

int main(int argc, char** argv) {
  std::string output = "honesty.json", work = ".", only, rows_folder;
  int seeds = 24;
  std::uint64_t first_seed = HonestyCase().first_seed;
  CLI::App app{"Intervals of the accuracy sampler against a plain path tracer"};
  app.add_option("--output", output, "figures");
  app.add_option("--work", work, "folder for the files that scenes name");
  app.add_option("--seeds", seeds, "renderings of each scene")->check(CLI::Range(8, 100000));
  app.add_option("--first-seed", first_seed, "seed of the first; the others follow");
  app.add_option("--only", only, "one scene (SCENE_psf: with the PSF only), or 'faults', or one fault");
  app.add_option("--rows", rows_folder, "folder for every pixel's errors and intervals, a CSV file a scene");
  CLI11_PARSE(app, argc, argv);
  try {
    write_scene_files(work);
    std::vector<Row> rows;
    for (const char* scene :
         {"penumbra", "leaf_crown", "wall_foot", "gable_roof", "texture", "mirror", "street_canyon"})
      for (const bool psf : {false, true}) {
        HonestyCase which{scene, psf, true, {}, seeds, first_seed, {}};
        if (!only.empty() && only != scene && only != name_of(which)) continue;
        if (!rows_folder.empty()) which.rows = std::filesystem::path(rows_folder) / (name_of(which) + ".csv");
        const HonestyOutcome outcome = run_case(which, work);
        print_details(which, outcome);
        rows.push_back(judged(which, outcome));
      }
    if (only.empty() || only.starts_with("fault")) {
      for (const auto& [name, which] : planted_faults(seeds, first_seed)) {
        if (!only.empty() && only != "faults" && only != name) continue;
        HonestyCase without = which;
        without.sun_state = true;
        without.faults = {};
        if (!rows_folder.empty()) without.rows = std::filesystem::path(rows_folder) / (name + "_without.csv");
        std::printf("    %s, then the same without it\n", name.c_str());
        const HonestyOutcome faulty = run_case(which, work), sound = run_case(without, work);
        print_details(which, faulty);
        print_details(without, sound);
        rows.push_back(caught(name, faulty, sound));
      }
    }
    std::ofstream(output) << json(rows);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
