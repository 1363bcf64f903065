#include "studies/thermal_study.h"

#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "studies/common/study_document.h"
#include "studies/common/study_files.h"
#include "studies/thermal_report.h"

namespace ifov::studies {

namespace {

constexpr double kMapSide_m = 8.0;

/// All shapes of the study are larger than half a pixel or seeded, so that a lattice of two cells per pixel side
/// meets them.
io::SamplingDocument asked(double error_c, bool pilot_rays = true) {
  return accuracy_sampling(radiance_of_error(error_c), [&](io::AccuracySampling& accuracy) {
    accuracy.lattice = 2;
    accuracy.pilot_rays = pilot_rays;
  });
}

constexpr bool kNoPilotRays = false;

std::vector<TrialSeries> all_series() {
  return {{"dome, 0.1 °C", Family::dome, asked(0.1)},
          {"dome, 0.01 °C", Family::dome, asked(0.01)},
          {"square, 0.1 °C", Family::square, asked(0.1)},
          {"rod, 0.1 °C", Family::rod, asked(0.1)},
          {"rod without pilot rays, 0.1 °C", Family::rod, asked(0.1, kNoPilotRays)},
          {"textured dome, 0.1 °C", Family::textured_dome, asked(0.1)},
          {"0.5 % target, 0.1 °C", Family::small_target, asked(0.1)},
          {"0.5 % target without pilot rays, 0.1 °C", Family::small_target, asked(0.1, kNoPilotRays)},
          {"5 % target, 0.1 °C", Family::large_target, asked(0.1)},
          {"dome, grid 28 x 28", Family::dome, grid_sampling(28)},
          {"dome, adaptive N = 20", Family::dome, paper_adaptive(20)},
          {"dome, adaptive N = 44", Family::dome, paper_adaptive(44)}};
}

void add_sweep_figures(const ThermalResults& r, FigureTable& figures) {
  figures.between("grid_samples_0p1", samples_that_stay_within(r.grid, 0.1), 15876, 15876, "samples",
                  "grid: samples over 3 x 3 pixels from which the error stays below 0.1 C");
  figures.report("grid_samples_0p01", samples_that_stay_within(r.grid, 0.01), "samples",
                 "the same for 0.01 C");
  for (const SweepPoint& p : r.adaptive) {
    if (p.setting != 20.0) continue;
    figures.between("adaptive_samples_n20", static_cast<double>(p.trial.cost.samples), 1109, 1129, "samples",
                    "adaptive, 10 x 10 sub-elements, at most 400 samples a pixel: samples over 3 x 3 pixels");
    figures.report("adaptive_error_n20", std::abs(p.trial.error_c), "C", "its error");
  }
  figures.report("adaptive_samples_0p1", samples_that_stay_within(r.adaptive, 0.1), "samples",
                 "adaptive: samples from which the error stays below 0.1 C");
}

void add_shift_figures(const ThermalResults& r, FigureTable& figures) {
  const auto summary = [&](std::string_view name) -> const TrialSummary& {
    for (const auto& [series, s] : r.series)
      if (series.name == name) return s;
    throw std::logic_error("no such series");
  };
  const auto reached = [&](const std::string& key, std::string_view name, double tolerance_c, double most,
                           const std::string& what) {
    const TrialSummary& s = summary(name);
    figures.at_most(
        key + "_samples", s.mean_samples, most, "samples",
        format("accuracy, {} C asked for: mean samples over 3 x 3 pixels, {}", tolerance_c, what));
    figures.at_least(key + "_within", s.within(tolerance_c), 0.95, "",
                     format("share of shifts within {} C", tolerance_c));
  };
  reached("dome_0p1", "dome, 0.1 °C", 0.1, 185, "dome");
  reached("dome_0p01", "dome, 0.01 °C", 0.01, 250, "dome");
  reached("square_0p1", "square, 0.1 °C", 0.1, 600, "rotated square");
  reached("rod_0p1", "rod, 0.1 °C", 0.1, 1300, "rod of 2 to 5 cm, seeded");
  const TrialSummary& rod_without_pilot = summary("rod without pilot rays, 0.1 °C");
  figures.at_most("rod_unseeded_within", rod_without_pilot.within(0.1), 0.9, "",
                  "share of shifts within 0.1 C without pilot rays: must miss the mark");
  reached("textured_0p1", "textured dome, 0.1 °C", 0.1, 2000, "dome and ground with texture");

  const TrialSummary &small = summary("0.5 % target, 0.1 °C"),
                     &without_pilot = summary("0.5 % target without pilot rays, 0.1 °C");
  figures.at_least("small_target_found", small.seen, 1.0, "", "share of 0.5 % targets found with pilot rays");
  figures.at_most("small_target_samples_per_pixel", small.mean_samples / 9.0, 20.0, "samples",
                  "samples per pixel that this takes");
  figures.at_most("small_target_found_unseeded", without_pilot.seen, 0.9, "",
                  "share found without pilot rays: must miss the mark");

  for (const auto& [key, name] : {std::pair{"dome", "dome, 0.1 °C"},
                                  {"square", "square, 0.1 °C"},
                                  {"large_target", "5 % target, 0.1 °C"}})
    figures.between(format("coverage_{}", key), summary(name).coverage, 0.94, 0.99, "",
                    format("share of 95 % intervals that hold the truth: {}", name));
  figures.report("grid_28_within", summary("dome, grid 28 x 28").within(0.1), "",
                 "share of shifts within 0.1 C, grid 28 x 28 (7,056 samples)");
  figures.report("adaptive_n20_within", summary("dome, adaptive N = 20").within(0.1), "",
                 "share of shifts within 0.1 C, adaptive at N = 20");
  figures.report("adaptive_n44_within", summary("dome, adaptive N = 44").within(0.1), "",
                 "share of shifts within 0.1 C, adaptive at N = 44");
}

}  // namespace

StudyOutcome run_thermal_study(const StudyOptions& options) {
  make_folder(options.output_folder);
  const std::filesystem::path& folder = options.output_folder;
  const bool quick = options.is_quick();
  const TextureMap texture(options.seed, kMapSide_m);
  texture.write(folder, "ground", kCold_k);
  texture.write(folder, "target", kHot_k);

  ThermalResults results;
  const std::vector<TrialSeries> series = all_series();
  const std::vector<double> errors = {2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005};
  const int largest = quick ? 60 : 300;
  StudyProgress progress(9 * (largest + static_cast<int>(errors.size()) +
                              static_cast<std::int64_t>(series.size()) * options.trials),
                         options.progress);
  results.grid = grid_sweep(largest, folder, options, progress);
  results.adaptive = adaptive_sweep(largest, folder, options, progress);
  results.accuracy = accuracy_sweep(errors, folder, options, progress);
  for (const TrialSeries& s : series) {
    if (options.log != nullptr) options.log->info(format("{}: {} shifts", s.name, options.trials));
    results.series.emplace_back(s, run_series(s, texture, folder, options, progress));
  }
  if (options.log != nullptr) options.log->info("clutter");
  results.clutter = run_clutter(folder, options);

  add_sweep_figures(results, results.figures);
  add_shift_figures(results, results.figures);
  add_clutter_figures(results.clutter, results.figures);
  StudyOutcome outcome{results.figures.text(), {}, results.figures.all_met()};
  const auto keep = [&](const char* name, const std::string& content) {
    write_file(folder / name, content);
    outcome.files.push_back(folder / name);
  };
  keep("figures.json", results.figures.json());
  ReportFigures drawn;
  keep("report.html", thermal_report(results, drawn));
  for (const auto& file : drawn.write(folder)) outcome.files.push_back(file);
  keep("dome.json", study_text(dome_scene(paper_dome()).document(asked(0.1), options.seed)));
  keep("textured_dome.json",
       study_text(
           random_scene(Family::textured_dome, options.seed, 0, texture).document(asked(0.1), options.seed)));
  return outcome;
}

}  // namespace ifov::studies
