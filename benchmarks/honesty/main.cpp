// Are the intervals honest on real 3-D scenes? Each scene's mixed pixels, many seeds, against a plain path
// tracer.
//   bench_honesty --output figures.json --work FOLDER [--seeds N] [--first-seed N] [--only SCENE] [--rows FOLDER]
//   bench_honesty --rows-study N ...: rows in step with the pixels, against exact areas
//   bench_honesty --named [SCENES] ...: scenes in which images were once wrong and sure of themselves
//   bench_honesty --images ...: errors of images as a whole, audited
//   bench_honesty --wild N ...: scenes by rule and chance, against closed forms and a tracer of its own
// Scenes must keep their promises; runs with a planted fault must break one of them.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "core/format.h"
#include "honesty/faulty_samplers.h"
#include "honesty/figure_row.h"
#include "honesty/image_run.h"
#include "honesty/named_scenes.h"
#include "honesty/reference_check.h"
#include "honesty/rows_report.h"
#include "honesty/scene_run.h"
#include "honesty/wild_report.h"

namespace {

using namespace ifov::benchmarks;

constexpr auto kReal = make_sampler<ifov::sampling::AccuracySampler>;

std::string name_of(const HonestyCase& which) {
  return which.scene + (which.stokes ? "_stokes" : which.psf ? "_psf" : which.groups ? "_groups" : "");
}

/// Scenes that are judged with the polarization of their light as well.
bool polarizes(const std::string& scene) {
  for (const char* one : {"glossy_car", "waves", "glass_front", "wet_road"})
    if (scene == one) return true;
  return false;
}

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
FigureRow judged(const HonestyCase& which, const HonestyOutcome& outcome) {
  double worst = 0.95;
  for (const ChannelHonesty& h : outcome.honesty)
    if (std::abs(h.coverage - 0.95) >= std::abs(worst - 0.95)) worst = h.coverage;
  const std::string fault = faults_of(outcome);
  return {name_of(which), ifov::format("{:.5f}", worst), "coverage", fault.empty() ? "0.93 to 0.995" : fault,
          fault.empty()};
}

/// 1 where a planted fault breaks a promise and the same scene without it keeps all of them.
FigureRow caught(const std::string& name, const HonestyOutcome& faulty, const HonestyOutcome& sound) {
  const std::string fault = faults_of(sound);
  const bool ok = fault.empty() && !faults_of(faulty).empty();
  return {name, ok ? "1" : "0", "caught", fault.empty() ? "1" : "1, but without the fault " + fault, ok};
}

/// Each on a scene where the mechanism that is switched off has to do the work, at that scene's own tolerance.
std::vector<std::pair<std::string, HonestyCase>> planted_faults(int seeds, std::uint64_t first_seed) {
  HonestyCase no_sun_state{"fences", false, false, kReal, seeds, first_seed, {}};
  HonestyCase certain{"patchwork", false,      true, make_sampler<SamplerOf<CertainSingles>>,
                      seeds,       first_seed, {}};
  HonestyCase undithered{"aligned_edge", false,      true, make_sampler<SamplerOf<Undithered>>,
                         10 * seeds,     first_seed, {}};
  HonestyCase unshifted{"gable_roof", false, true, kReal, seeds, first_seed, {}};
  unshifted.groups = unshifted.unshifted = true;
  return {{"fault_no_sun_state", no_sun_state},
          {"fault_unshifted_channels", unshifted},
          {"fault_certain_single_samples", certain},
          {"fault_undithered_brackets", undithered}};
}

int save(const std::string& file, const std::vector<FigureRow>& rows) {
  std::ofstream out(file);
  out << json(rows);
  if (!out.flush()) throw std::runtime_error("cannot write " + file);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::string output = "honesty.json", work = ".", only, rows_folder;
  int seeds = 24, rows_steps = 0, wild_scenes = 0, pixels = 24, threads = 0;
  double effort = 1.0, boast = 1.0;
  bool check = false, images = false;
  std::vector<std::string> kinds, named;
  std::uint64_t first_seed = HonestyCase().first_seed;
  CLI::App app{"Intervals of the accuracy sampler against a plain path tracer"};
  app.add_option("--output", output, "figures");
  app.add_option("--work", work, "folder for the files that scenes name");
  app.add_option("--seeds", seeds, "renderings of each scene (--wild: 3)")->check(CLI::Range(1, 100000));
  app.add_option("--first-seed", first_seed, "seed of the first; the others follow");
  app.add_option(
      "--only", only,
      "one scene (SCENE_psf, SCENE_groups: with the PSF, or one of each channel, only), or 'faults', or one fault");
  app.add_option("--rows", rows_folder, "folder for every pixel's errors and intervals, a CSV file a scene");
  app.add_option("--rows-study", rows_steps, "nothing but rows of N pitches as maps, boxes and meshes")
      ->check(CLI::Range(1, 100000));
  app.add_option("--wild", wild_scenes,
                 "nothing but N scenes by rule and chance, from number --first-seed on")
      ->check(CLI::Range(1, 1000000));
  CLI::Option* named_option =
      app.add_option("--named", named, "nothing but scenes that were once wrong: these, or all")
          ->expected(0, -1)
          ->delimiter(',');
  app.add_option("--kinds", kinds, "of wild scenes; the others are passed over")->delimiter(',');
  app.add_option("--pixels", pixels, "judged in each wild scene; 0: all")->check(CLI::Range(0, 100000));
  app.add_option("--effort", effort, "of the plain tracer, in its usual most paths")
      ->check(CLI::Range(0.001, 1000.0));
  app.add_option("--boast", boast,
                 "a planted fault: half-widths and sigmas of --wild and --named are taken to be this times "
                 "what they are")
      ->check(CLI::Range(0.0, 1.0));
  app.add_flag("--images", images, "nothing but errors of images as a whole, audited");
  app.add_flag("--check-reference", check, "nothing but the plain tracer against closed forms");
  app.add_option("--threads", threads, "0: all cores");
  CLI11_PARSE(app, argc, argv);
  try {
    std::filesystem::create_directories(work);
    if (rows_steps > 0) {
      RowsStudy study{rows_steps, first_seed, work, {}, threads};
      if (!rows_folder.empty()) study.rows = std::filesystem::path(rows_folder) / "rows_study.csv";
      return save(output, report_rows_study(study));
    }
    if (check) {
      return save(output, check_reference(work));
    }
    Judging judging;
    judging.boast = boast;
    judging.most_paths *= effort;
    judging.most_photons *= effort;
    judging.rows = rows_folder;
    if (wild_scenes > 0) {
      if (app.count("--seeds") > 0) judging.seeds = seeds;
      judging.pixels = pixels;
      return save(output, report_wild_run({wild_scenes, first_seed, kinds, work, threads, judging}));
    }
    if (named_option->count() > 0) {
      judging.seeds = app.count("--seeds") > 0 ? seeds : 20;
      judging.first_seed = first_seed;
      judging.pixels = app.count("--pixels") > 0 ? pixels : 0;
      std::erase(named, "");
      return save(output, report_named_scenes(named, work, judging, threads));
    }
    write_scene_files(work);
    if (images) return save(output, report_images(only, seeds, first_seed, work));
    std::vector<FigureRow> rows;
    for (const char* scene : {"penumbra", "leaf_crown", "wall_foot", "gable_roof", "texture", "mirror",
                              "street_canyon", "glossy_car", "waves", "glass_front", "wet_road"})
      for (const char* kind : {"", "psf", "groups", "stokes"}) {
        HonestyCase which;
        which.scene = scene;
        which.psf = kind == std::string("psf"), which.stokes = kind == std::string("stokes");
        which.groups = kind == std::string("groups");
        which.seeds = seeds, which.first_seed = first_seed;
        if (which.stokes && !polarizes(scene)) continue;
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
        without.unshifted = false;
        without.sampler = kReal;
        if (!rows_folder.empty()) without.rows = std::filesystem::path(rows_folder) / (name + "_without.csv");
        std::printf("    %s, then the same without it\n", name.c_str());
        const HonestyOutcome faulty = run_case(which, work), sound = run_case(without, work);
        print_details(which, faulty);
        print_details(without, sound);
        rows.push_back(caught(name, faulty, sound));
      }
    }
    return save(output, rows);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
