#include "studies/aliasing_study.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "studies/aliasing_report.h"
#include "studies/common/study_document.h"
#include "studies/common/study_files.h"
#include "studies/common/study_progress.h"
#include "studies/common/study_rendering.h"

namespace ifov::studies {

namespace {

constexpr double kAngles_deg[] = {7.0, 24.3, 41.6};
constexpr int kRepeats = 3;  // of each timing; the fastest counts

io::ErrorSize reflectance_error(double share_of_contrast) {
  const double error = share_of_contrast * (ChartScene::kWhite - ChartScene::kBlack);
  return {std::stod(format("{:.6g}", error)), io::ErrorSize::Unit::reflectance};
}

/// Renders every chart one way and measures errors in units of the contrast.
ChartResult measure(const std::string& name, const io::SamplingDocument& sampling,
                    const std::vector<ChartScene>& charts, int repeats, const StudyOptions& options,
                    StudyProgress& progress) {
  ChartResult result;
  result.name = name;
  result.sampling = sampling;
  double squares = 0.0;
  std::size_t pixels = 0, mixed = 0, held = 0;
  std::vector<double> absolute;
  for (const ChartScene& chart : charts) {
    auto image = std::make_unique<ImageStore>();
    double fastest = 0.0;
    for (int k = 0; k < repeats; ++k) {
      const RenderTimes times =
          render_document(study_text(chart.document(sampling, options.seed)), options.output_folder,
                          {1, options.cancel, nullptr, {}}, *image);
      fastest = k == 0 ? times.render_s : std::min(fastest, times.render_s);
      progress.add(ChartScene::kWidth_px * ChartScene::kWidth_px, image->cost().rays.total());
    }
    result.seconds += fastest;
    // The corner shows nothing but paper.
    const double white = static_cast<double>(image->mean()[0]);
    const double contrast = white * (1.0 - ChartScene::kBlack / ChartScene::kWhite);
    for (std::size_t p = 0; p < chart.black_fraction().size(); ++p, ++pixels) {
      const double black = chart.black_fraction()[p];
      const double error = (white - static_cast<double>(image->mean()[p])) / contrast - black;
      squares += error * error;
      absolute.push_back(std::abs(error));
      result.error.push_back(error);
      if (black > 1e-6 && black < 1.0 - 1e-6) {
        ++mixed;
        held += std::abs(error) <= static_cast<double>(image->half_width()[p]) / contrast + 1e-6;
      }
      result.most_samples = std::max(result.most_samples, image->samples()[p]);
      result.fewest_samples = std::min(result.fewest_samples, image->samples()[p]);
    }
    result.cost += image->cost();
    if (!result.image) result.image = std::move(image);
  }
  std::nth_element(absolute.begin(), absolute.begin() + static_cast<std::ptrdiff_t>(0.99 * double(pixels)),
                   absolute.end());
  result.error_99 = absolute[static_cast<std::size_t>(0.99 * double(pixels))];
  result.worst = *std::max_element(absolute.begin(), absolute.end());
  result.rms = std::sqrt(squares / double(pixels));
  result.coverage = double(held) / double(mixed);
  result.samples_per_px = double(result.cost.samples) / double(pixels);
  return result;
}

void add_figures(AliasingResults& r) {
  FigureTable& f = r.figures;
  const ChartResult &one = r.results[0], &ten = r.results[1], &adaptive = r.results[2];
  f.report("grid_1_rms", one.rms, "contrast", "RMS error, one ray a pixel");
  f.report("grid_10_rms", ten.rms, "contrast", "RMS error, grid 10 x 10");
  f.report("adaptive_samples_per_pixel", adaptive.samples_per_px, "samples",
           "adaptive, 9 sub-elements, at most 100 samples: mean samples per pixel");
  f.between("adaptive_fewest_samples", adaptive.fewest_samples, 9, 9, "samples", "fewest of any pixel");
  f.at_most("adaptive_most_samples", adaptive.most_samples, 100, "samples", "most of any pixel");
  f.report("adaptive_rms_over_grid_10", adaptive.rms / ten.rms, "",
           "its RMS error over that of the grid 10 x 10");
  f.report("adaptive_time_over_grid_10", adaptive.seconds / ten.seconds, "",
           "its wall time over that of the grid 10 x 10");
  const ChartResult& best = r.results[r.chosen];
  f.report("accuracy_samples_per_pixel", best.samples_per_px, "samples",
           "accuracy sampling, the cheapest setting that errs no more than the grid 10 x 10");
  f.at_most("accuracy_rms_over_grid_10", best.rms / ten.rms, 1.0, "",
            "its RMS error over that of the grid 10 x 10");
  f.at_least("accuracy_fewer_samples_than_grid_10", ten.samples_per_px / best.samples_per_px, 9.0, "times",
             "samples of the grid 10 x 10 over those of accuracy sampling");
  f.at_least("accuracy_less_time_than_grid_10", ten.seconds / best.seconds, 6.0, "times",
             "wall time of the grid 10 x 10 over that of accuracy sampling, one thread");
  f.report("accuracy_coverage_mixed_pixels", best.coverage, "",
           "share of intervals in mixed pixels that hold the truth");
  f.report("accuracy_shadow_rays_per_pixel",
           double(best.cost.rays.shadow) / double(best.cost.samples) * best.samples_per_px, "rays",
           "shadow rays beside those samples");
}

}  // namespace

StudyOutcome run_aliasing_study(const StudyOptions& options) {
  make_folder(options.output_folder);
  const bool quick = options.is_quick();
  std::vector<ChartScene> charts;
  for (double angle : kAngles_deg) {
    charts.emplace_back(angle * std::numbers::pi / 180.0, options.seed + charts.size());
    if (quick) break;
  }
  struct Way {
    std::string name;
    io::SamplingDocument sampling;
  };
  std::vector<Way> ways = {{"one ray", single_sampling()},
                           {"grid 10 x 10", grid_sampling(10)},
                           {"adaptive, 9 sub-elements, at most 100",
                            adaptive_sampling(3, 100, {0.01, io::ErrorSize::Unit::fraction})},
                           {"grid 5 x 5", grid_sampling(5)},
                           {"grid 20 x 20", grid_sampling(20)}};
  const std::size_t first_accuracy = ways.size();
  for (int lattice : {1, 2, 3})
    for (double share : {0.04, 0.02, 0.01})
      ways.push_back({format("accuracy {:g} % of contrast, lattice {}", 100 * share, lattice),
                      accuracy_sampling(reflectance_error(share), [&](io::AccuracySampling& accuracy) {
                        accuracy.lattice = lattice;
                      })});

  const int repeats = quick ? 1 : kRepeats;
  StudyProgress progress(static_cast<std::int64_t>(ways.size() * charts.size()) * repeats *
                             ChartScene::kWidth_px * ChartScene::kWidth_px,
                         options.progress);
  AliasingResults results;
  for (const Way& way : ways) {
    if (options.log != nullptr) options.log->info(way.name);
    results.results.push_back(measure(way.name, way.sampling, charts, repeats, options, progress));
  }
  results.chosen = first_accuracy;
  const double limit = results.results[1].rms;
  for (std::size_t k = first_accuracy; k < results.results.size(); ++k) {
    const ChartResult &best = results.results[results.chosen], &other = results.results[k];
    const bool cheaper = other.samples_per_px < best.samples_per_px;
    if (best.rms > limit ? other.rms < best.rms : other.rms <= limit && cheaper) results.chosen = k;
  }
  results.black_fraction = charts.front().black_fraction();
  add_figures(results);

  StudyOutcome outcome{results.figures.text(), {}, results.figures.all_met()};
  const auto keep = [&](const char* name, const std::string& content) {
    write_file(options.output_folder / name, content);
    outcome.files.push_back(options.output_folder / name);
  };
  keep("figures.json", results.figures.json());
  ReportFigures drawn;
  keep("report.html", aliasing_report(results, drawn));
  for (const auto& file : drawn.write(options.output_folder)) outcome.files.push_back(file);
  keep("chart.json",
       study_text(charts.front().document(results.results[results.chosen].sampling, options.seed)));
  return outcome;
}

}  // namespace ifov::studies
