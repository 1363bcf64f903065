#include "studies/suburb/suburb_study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "core/format.h"
#include "io/document/document.h"
#include "studies/common/scene_renderer.h"
#include "studies/common/study_files.h"
#include "studies/common/suburb_scene.h"
#include "studies/suburb/channel_cost.h"
#include "studies/suburb/sampling_ways.h"
#include "studies/suburb/suburb_report.h"

namespace ifov::studies {

namespace {

constexpr std::size_t kTen = 2;        // the grid 10 x 10 among the results
constexpr int kReferenceSide = 64;     // rays along a pixel's side
constexpr int kReferenceTile_px = 20;  // radiance of the reference is made for one tile in kReferenceShare
constexpr int kReferenceShare = 5;
constexpr int kSearches = 4;           // accuracy settings that are tried
constexpr double kFirstError = 0.034;  // of reflectance
constexpr double kFirstErrorByLargest = 0.07;
constexpr double kErrorPower = 0.6;  // the RMS error in the worst band falls faster than the error asked for
constexpr double kPaperSamples = 52.0;
constexpr double kPaperMaterials = 1.65 / 1.58;  // adaptive over grid 10 x 10
constexpr double kComparedAt_um = 0.55;          // where the paper shows its image
constexpr double kWithinPathNoise = 0.95;        // share of pixels, of pairs of rays through one point

/// Renders ways of sampling one scene and holds them against its reference.
class SuburbStudy {
 public:
  SuburbStudy(const io::Document& document, const StudyOptions& options, bool quick)
      : document_(document), options_(options), quick_(quick), renderer_(document, options.log) {}

  SceneResults run() {
    make_reference();
    for (const SamplingWay& way : {grid_way(1), grid_way(5), grid_way(10)}) add(way);
    out_.adaptive = judged_by_adaptive();
    add(adaptive_way(renderer_.info().channels[out_.adaptive.channel].name,
                     out_.adaptive.allowed_difference));
    out_.chosen = search(&ErrorRatios::worst, kFirstError);
    out_.chosen_by_largest = search(&ErrorRatios::largest, kFirstErrorByLargest);
    out_.curves = image_curves(document_, radiance_, out_.results[kTen].errors, options_, quick_);
    judge();
    return std::move(out_);
  }

 private:
  void say(const std::string& what) const {
    if (options_.log != nullptr) options_.log->info(what);
  }

  SceneRenderer::Choices choices() const {
    return {options_.threads, 64, {}, options_.cancel, options_.progress};
  }

  void make_reference() {
    const render::ImageInfo& info = renderer_.info();
    for (const render::ChannelInfo& channel : info.channels) out_.wavelengths_um.push_back(channel.centre_um);
    out_.materials = info.materials;
    out_.lighting = renderer_.lighting();
    const int side = quick_ ? 16 : kReferenceSide;
    say(format("reference: materials, {} x {} labels a pixel", side, side));
    renderer_.render_abundances(side, choices(), materials_);

    const int across = (info.width_px + kReferenceTile_px - 1) / kReferenceTile_px;
    const int down = (info.height_px + kReferenceTile_px - 1) / kReferenceTile_px;
    std::vector<int> tiles;
    for (int k = 0; k < across * down; ++k)  // a knight's move spreads them over the image
      if ((k % across + 2 * (k / across)) % kReferenceShare == 0) tiles.push_back(k);
    say(format("reference: radiance, {} x {} rays a pixel in {} of {} tiles", side, side, tiles.size(),
               across * down));
    SceneRenderer::Choices some = choices();
    some.tile_px = kReferenceTile_px;
    some.tiles = tiles;
    renderer_.render(grid_way(side).sampling, some, radiance_);
    const auto& samples = radiance_.samples();
    out_.reference_pixels =
        double(std::count_if(samples.begin(), samples.end(), [](auto n) { return n > 0; })) /
        double(samples.size());
  }

  AdaptiveRule judged_by_adaptive() const {
    say("path noise: one ray a pixel once more");
    SceneRenderer::Choices again = choices();
    again.seed = options_.seed + 1;
    ImageStore other;
    renderer_.render(grid_way(1).sampling, again, other);
    const ImageStore& one = *out_.results[0].image;
    AdaptiveRule rule;
    for (std::size_t c = 0; c < out_.wavelengths_um.size(); ++c)
      if (std::abs(out_.wavelengths_um[c] - kComparedAt_um) <
          std::abs(out_.wavelengths_um[rule.channel] - kComparedAt_um))
        rule.channel = c;
    rule.allowed_difference = path_noise(one.mean(), other.mean(), rule.channel, one.columns());
    return rule;
  }

  void add(const SamplingWay& way) {
    say(way.name);
    SceneResult result;
    result.name = way.name;
    result.sampling = way.text;
    result.image = std::make_unique<ImageStore>();
    result.seconds = renderer_.render(way.sampling, choices(), *result.image);
    const auto& samples = result.image->samples();
    result.samples_per_px =
        double(std::accumulate(samples.begin(), samples.end(), std::uint64_t{0})) / double(samples.size());
    const auto [fewest, most] = std::minmax_element(samples.begin(), samples.end());
    result.fewest_samples = *fewest;
    result.most_samples = *most;
    result.materials = count_materials(*result.image);
    // Twice the RMS error of a lattice of n x n points along an edge through a pixel, 0.46 n^-3/2.
    const double uncertainty = 2.0 * 0.46 * std::pow(quick_ ? 16.0 : kReferenceSide, -1.5);
    result.abundances = compare_abundances(*result.image, materials_, uncertainty);
    result.errors = radiance_errors(*result.image, radiance_);
    out_.results.push_back(std::move(result));
    if (out_.results.size() <= kTen) return;
    for (SceneResult& each : out_.results)
      each.over_grid = error_ratios(each.errors, out_.results[kTen].errors);
  }

  /// The largest error asked for that keeps a ratio to the grid's error at 1 or less, as near as a few trials come: the
  /// result of it.
  std::size_t search(double ErrorRatios::*ratio_of, double error) {
    struct Tried {
      double error = 0.0, ratio = 0.0;
    };
    std::optional<Tried> met, missed;
    for (int k = 0; k < (quick_ ? 1 : kSearches); ++k) {
      add(accuracy_way(error));
      const double ratio = out_.results.back().over_grid.*ratio_of;
      (ratio <= 1.0 ? met : missed) = {error, ratio};
      if (ratio <= 1.0 && ratio > 0.95) break;
      if (met && missed)  // between them, as a power of the error
        error = met->error * std::pow(missed->error / met->error,
                                      std::log(0.975 / met->ratio) / std::log(missed->ratio / met->ratio));
      else
        error *= std::clamp(std::pow(0.97 / ratio, kErrorPower), 0.3, 3.0);
    }
    constexpr std::size_t kFirst = 4;
    std::size_t chosen = kFirst;
    for (std::size_t k = kFirst; k < out_.results.size(); ++k) {
      const SceneResult &best = out_.results[chosen], &other = out_.results[k];
      const bool meets = other.over_grid.*ratio_of <= 1.0;
      if (best.over_grid.*ratio_of > 1.0 ? other.over_grid.*ratio_of < best.over_grid.*ratio_of
                                         : meets && other.seconds < best.seconds)
        chosen = k;
    }
    return chosen;
  }

  void judge() {
    FigureTable& f = out_.figures;
    const SceneResult &one = out_.results[0], &five = out_.results[1], &ten = out_.results[kTen],
                      &adaptive = out_.results[3], &ours = out_.results[out_.chosen];
    const MaterialCounts truth = count_materials(materials_);
    f.report("materials_per_pixel_reference", truth.counted, "",
             "materials of at least 0.1 % of a pixel's area, mean over pixels, reference");
    f.report("materials_per_pixel_reference_raw", truth.raw, "",
             "the same with every material that any ray met");
    for (const auto& [name, r] : {std::pair{"grid_1", &one},
                                  {"grid_5", &five},
                                  {"grid_10", &ten},
                                  {"adaptive", &adaptive},
                                  {"accuracy", &ours}}) {
      f.report(format("materials_per_pixel_{}", name), r->materials.counted, "", format("by {}", r->name));
      f.report(format("abundance_rms_{}", name), r->abundances.rms, "", "its RMS error of abundances");
      f.report(format("rms_over_grid_10_{}", name), r->over_grid.mean, "",
               "its RMS error of radiance over that of the grid 10 x 10, root mean square over the channels");
      if (r != &one)
        f.report(format("time_over_grid_1_{}", name), r->seconds / one.seconds, "times",
                 "its wall time over that of one ray a pixel");
    }
    f.report("adaptive_channel", out_.wavelengths_um[out_.adaptive.channel], "um",
             "adaptive: centre of the channel in which it compares, the one of the image");
    f.report(
        "adaptive_allowed_difference", out_.adaptive.allowed_difference, "",
        "the difference it allows, as a share of the average: two rays through one point differ by less in 95 % of "
        "pixels");
    f.between("adaptive_fewest_samples", adaptive.fewest_samples, 25, 25, "samples", "fewest of any pixel");
    f.between("samples_per_pixel_adaptive", adaptive.samples_per_px, 40, 60, "samples",
              format("adaptive; the paper's took {:g}", kPaperSamples));
    f.between("adaptive_most_samples", adaptive.most_samples, 100, 100, "samples", "most of any pixel");
    f.between("adaptive_materials_over_grid_10", adaptive.materials.counted / ten.materials.counted,
              0.95 * kPaperMaterials, 1.05 * kPaperMaterials, "",
              format("its materials per pixel over those of the grid 10 x 10; the paper's {:.3f}",
                     kPaperMaterials));
    f.report("samples_per_pixel_accuracy", ours.samples_per_px, "samples", ours.name);
    f.at_most("accuracy_abundance_rms_over_grid_10", ours.abundances.rms / ten.abundances.rms, 1.0, "",
              "RMS error of abundances over that of the grid 10 x 10");
    f.at_most("accuracy_rms_over_grid_10_worst_band", ours.over_grid.worst, 1.0, "",
              "RMS error of radiance over that of the grid 10 x 10, in the band where that is largest");
    f.at_least("accuracy_less_time_than_grid_10", ten.seconds / ours.seconds, 2.5, "times",
               "wall time of the grid 10 x 10 over that of accuracy sampling that is no worse in any band");
    const SceneResult& largest = out_.results[out_.chosen_by_largest];
    f.report("accuracy_largest_rms_over_grid_10", largest.over_grid.largest, "",
             format("{}: largest RMS error of any band over the largest of the grid 10 x 10", largest.name));
    f.report("accuracy_less_time_by_largest_rms", ten.seconds / largest.seconds, "times",
             "wall time of the grid 10 x 10 over that of this setting");
    f.report("accuracy_coverage", ours.errors.coverage, "",
             "share of radiance intervals that hold the reference");
    f.report("accuracy_abundance_coverage", ours.abundances.coverage, "",
             "share of abundance intervals in mixed pixels that hold the reference");
    f.append(out_.curves.figures);
  }

  const io::Document& document_;
  const StudyOptions& options_;
  bool quick_;
  SceneRenderer renderer_;
  ImageStore materials_, radiance_;  // references
  SceneResults out_;
};

}  // namespace

double path_noise(std::span<const float> one, std::span<const float> other, std::size_t channel,
                  int columns) {
  const std::size_t stride = static_cast<std::size_t>(columns), pixels = one.size() / stride;
  std::vector<double> noise(pixels);
  for (std::size_t p = 0; p < pixels; ++p) {
    const double own = static_cast<double>(one[p * stride + channel]);
    noise[p] = std::abs(static_cast<double>(other[p * stride + channel]) - own) / std::abs(own);
  }
  const auto at = noise.begin() + static_cast<std::ptrdiff_t>(kWithinPathNoise * double(pixels - 1));
  std::nth_element(noise.begin(), at, noise.end());
  return std::stod(format("{:.2g}", *at));
}

StudyOutcome run_suburb_study(const StudyOptions& options) {
  make_folder(options.output_folder);
  const bool quick = options.is_quick();
  const io::Document document = suburb_document(options, quick);
  SceneResults results = SuburbStudy(document, options, quick).run();
  add_channel_cost(document, options, quick, results.figures);

  StudyOutcome outcome{results.figures.text(), {}, results.figures.all_met()};
  const auto keep = [&](const char* name, const std::string& content) {
    write_file(options.output_folder / name, content);
    outcome.files.push_back(options.output_folder / name);
  };
  keep("figures.json", results.figures.json());
  ReportFigures drawn;
  keep("report.html", suburb_report(results, drawn));
  for (const auto& file : drawn.write(options.output_folder)) outcome.files.push_back(file);
  return outcome;
}

}  // namespace ifov::studies
