#include "studies/clutter_trials.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/pixel_sampler.h"
#include "studies/common/html_page.h"
#include "studies/common/image_store.h"
#include "studies/common/study_document.h"
#include "studies/common/study_rendering.h"
#include "studies/thermal_scene.h"

namespace ifov::studies {

namespace {

constexpr int kWidth_px = 64, kRim_px = 3, kFine = 32;
constexpr double kSigma_px = 0.6, kCellsPerPx = 330.0 / (17.0 * 17.0), kDenseCellsPerPx = 12.0;

void trace_edges(io::AccuracySampling& accuracy) { accuracy.clutter = false; }
/// No probes: in clutter, edges are met everywhere.
void trace_edges_unprobed(io::AccuracySampling& accuracy) {
  trace_edges(accuracy);
  accuracy.probes = 0;
}

ClutterResult judge(const std::string& what, const ImageStore& image, const std::vector<double>& truth,
                    double render_s) {
  ClutterResult result{what, 0.0, 0.0, 0.0, render_s};
  int pixels = 0;
  for (int y = kRim_px; y < image.height() - kRim_px; ++y)
    for (int x = kRim_px; x < image.width() - kRim_px; ++x, ++pixels) {
      const std::size_t p = image.index(x, y);
      const double error = error_c(static_cast<double>(image.mean()[p]) - truth[p]);
      result.rms_c += error * error;
      result.coverage += std::abs(error) <= error_c(static_cast<double>(image.half_width()[p])) + 1e-4;
    }
  result.rms_c = std::sqrt(result.rms_c / pixels);
  result.coverage /= pixels;
  result.samples_per_px = static_cast<double>(image.cost().samples) / (image.width() * image.height());
  return result;
}

/// One clutter scene with its truth, rendered in many ways.
class Bench {
 public:
  Bench(const ClutterScene& scene, double psf_sigma_px, std::vector<double> truth,
        const std::filesystem::path& folder, const StudyOptions& options)
      : scene_(scene),
        psf_sigma_px_(psf_sigma_px),
        truth_(std::move(truth)),
        folder_(folder),
        options_(options) {}

  ClutterResult run(const std::string& what, const io::SamplingDocument& sampling,
                    const sampling::PixelSampler* sampler = nullptr) const {
    ImageStore image;
    const double seconds = render(sampling, {options_.threads, options_.cancel, sampler, {}}, image);
    return judge(what, image, truth_, seconds);
  }
  double render(const io::SamplingDocument& sampling, const RenderChoices& choices, ImageStore& image) const {
    return render_document(study_text(scene_.document(sampling, psf_sigma_px_, options_.seed)), folder_,
                           choices, image)
        .render_s;
  }
  const std::vector<double>& truth() const { return truth_; }

 private:
  const ClutterScene& scene_;
  double psf_sigma_px_;
  std::vector<double> truth_;
  const std::filesystem::path& folder_;
  const StudyOptions& options_;
};

io::SamplingDocument with_tile(io::SamplingDocument sampling, int tile_px) {
  sampling.tile_px = tile_px;
  return sampling;
}

bool same(const ImageStore& a, const ImageStore& b) {
  return a.mean() == b.mean() && a.half_width() == b.half_width() && a.samples() == b.samples();
}

void check_tiles(const Bench& bench, const CancelToken* cancel, ClutterStudy& study) {
  constexpr int kTile_px = 16, kTiles = (kWidth_px / kTile_px) * (kWidth_px / kTile_px);
  const io::SamplingDocument sampling = accuracy_sampling(radiance_of_error(0.5));
  ImageStore first, large;
  bench.render(with_tile(sampling, kTile_px), {1, cancel, nullptr, {}}, first);
  bench.render(with_tile(sampling, kWidth_px), {1, cancel, nullptr, {}}, large);
  std::vector<int> backwards;
  for (int k = kTiles; k-- > 0;) backwards.push_back(k);
  study.same_bytes = true;
  for (int threads : {1, 2, 7}) {
    ImageStore again;
    bench.render(with_tile(sampling, kTile_px), {threads, cancel, nullptr, backwards}, again);
    study.same_bytes &= same(first, again);
  }
  int agree = 0, pixels = 0;
  double rim = 0.0, inside = 0.0;
  int rim_pixels = 0;
  for (int y = kRim_px; y < kWidth_px - kRim_px; ++y)
    for (int x = kRim_px; x < kWidth_px - kRim_px; ++x, ++pixels) {
      const std::size_t p = large.index(x, y);
      agree += std::abs(first.mean()[p] - large.mean()[p]) <= first.half_width()[p] + large.half_width()[p];
      const double error = static_cast<double>(first.mean()[p]) - bench.truth()[p];
      const auto at_rim = [](int v) { return v % kTile_px == 0 || v % kTile_px == kTile_px - 1; };
      const bool rim_pixel = at_rim(x) || at_rim(y);
      rim_pixels += rim_pixel;
      (rim_pixel ? rim : inside) += error * error;
    }
  study.tiles_agree = static_cast<double>(agree) / pixels;
  study.seam_ratio = std::sqrt(rim / rim_pixels / (inside / (pixels - rim_pixels)));
}

}  // namespace

double rays_at_rms(std::vector<ClutterResult> results, double rms_c) {
  std::sort(results.begin(), results.end(), [](const auto& a, const auto& b) { return a.rms_c > b.rms_c; });
  for (std::size_t k = 0; k + 1 < results.size(); ++k) {
    const ClutterResult &worse = results[k], &better = results[k + 1];
    if (worse.rms_c < rms_c || better.rms_c > rms_c || worse.rms_c == better.rms_c) continue;
    const double share = std::log(worse.rms_c / rms_c) / std::log(worse.rms_c / better.rms_c);
    return worse.samples_per_px * std::pow(better.samples_per_px / worse.samples_per_px, share);
  }
  return results.front().rms_c <= rms_c ? results.front().samples_per_px
                                        : std::numeric_limits<double>::infinity();
}

ClutterStudy run_clutter(const std::filesystem::path& folder, const StudyOptions& options) {
  ClutterStudy study;
  const ClutterScene scene(kWidth_px, kCellsPerPx, options.seed);
  const Bench blurred(scene, kSigma_px, scene.blurred_truth(kSigma_px, kFine), folder, options);
  sampling::AccuracyOptions drawn;
  drawn.probes_per_side = 0;
  drawn.footprint_by_model = false;
  const sampling::AccuracySampler drawn_sampler(drawn);
  for (double error : {4.0, 2.0, 1.0, 0.5, 0.25, 0.12}) {
    const io::ErrorSize asked = radiance_of_error(error);
    study.psf_model.push_back(
        blurred.run(format("accuracy {} °C", error), accuracy_sampling(asked, trace_edges_unprobed)));
    study.psf_drawn.push_back(blurred.run(format("accuracy {} °C, rays drawn from the PSF", error),
                                          accuracy_sampling(asked), &drawn_sampler));
  }
  for (int n : {4, 6, 8, 10, 12})
    study.psf_grid.push_back(blurred.run(format("grid {0} x {0}", n), grid_sampling(n)));

  const ClutterScene dense(kWidth_px / 2, kDenseCellsPerPx, options.seed);
  const Bench mosaic(dense, 0.0, dense.pixel_truth(), folder, options);
  for (double error : {4.0, 2.0, 1.0}) {
    const io::ErrorSize asked = radiance_of_error(error);
    study.dense_switched.push_back(mosaic.run(format("accuracy {} °C", error), accuracy_sampling(asked)));
    study.dense_traced.push_back(
        mosaic.run(format("accuracy {} °C, edges traced", error), accuracy_sampling(asked, trace_edges)));
  }
  const Bench sharp(scene, 0.0, scene.pixel_truth(), folder, options);
  check_tiles(sharp, options.cancel, study);
  return study;
}

void add_clutter_figures(const ClutterStudy& study, FigureTable& figures) {
  constexpr double kMost = 45.0;
  figures.at_most("psf_rays_per_pixel", rays_at_rms(study.psf_model, 0.06), kMost, "rays",
                  "rays per pixel for 0.06 C RMS, PSF of sigma 0.6 px in clutter, PSF integrated over the "
                  "traced picture");
  figures.at_least("psf_rays_per_pixel_drawn", rays_at_rms(study.psf_drawn, 0.06), kMost, "rays",
                   "the same with rays drawn from the PSF instead: must miss the mark");
  figures.report("psf_rays_per_pixel_grid", rays_at_rms(study.psf_grid, 0.06), "rays",
                 "the same with the rays of a grid, shared by pixels");
  const ClutterResult &on = study.dense_switched.front(), &off = study.dense_traced.front();
  figures.report("dense_clutter_samples_per_pixel", on.samples_per_px, "samples",
                 "12 materials' patches in every pixel, 4 C asked for");
  figures.at_least("dense_clutter_samples_ratio_without_switch", off.samples_per_px / on.samples_per_px, 1.0,
                   "", "what the same costs where edges are traced all the same");
  figures.between("same_bytes_any_threads", study.same_bytes, 1, 1, "",
                  "1, 2 and 7 threads and tiles in reverse order give the same bytes");
  figures.at_least("tiles_16_and_64_agree", study.tiles_agree, 0.95, "",
                   "share of pixels whose intervals overlap");
  figures.between("seam_ratio", study.seam_ratio, 0.8, 1.25, "",
                  "RMS error of pixels at the rims of 16 px tiles over that of the others");
}

std::string clutter_html(const ClutterStudy& study) {
  std::string rows;
  const auto add = [&rows](const std::string& scene, const std::vector<ClutterResult>& results) {
    for (const ClutterResult& r : results)
      rows += format(
          "<tr><td>{}</td><td>{}</td><td class=\"n\">{:.1f}</td><td class=\"n\">{:.4f}</td><td "
          "class=\"n\">{:.3f}</td></tr>\n",
          scene, html_text(r.what), r.samples_per_px, r.rms_c, r.coverage);
  };
  add("PSF of 0.6 px", study.psf_model);
  add("PSF of 0.6 px", study.psf_drawn);
  add("PSF of 0.6 px", study.psf_grid);
  add("dense", study.dense_switched);
  add("dense", study.dense_traced);
  return "<table><tr><th>clutter</th><th>sampling</th><th>samples per pixel</th><th>RMS error, "
         "°C</th><th>intervals that "
         "hold the truth</th></tr>\n" +
         rows + "</table>\n";
}

}  // namespace ifov::studies
