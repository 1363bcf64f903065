#include "studies/suburb/image_curves.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <span>

#include "core/format.h"
#include "io/document/document.h"
#include "io/library/sensor_presets.h"
#include "studies/common/scene_renderer.h"
#include "studies/suburb/sampling_ways.h"

namespace ifov::studies {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kSeeds = 3, kAudited = 200;
constexpr int kGrids[] = {5, 7, 10, 14, 20}, kQuickGrids[] = {5, 10};
constexpr double kJudgedLimit =
    1.4;  // of which the report tells most: what nodes may be off by is part of limits
constexpr double kLimits[] = {2.8, 2.0, 1.4, 1.0}, kQuickLimits[] = {2.0, 1.4};

/// What MODIS was required to have in the bands of its land, the first seven, as a radiance; between them by straight lines.
double modis_noise(double wavelength_um) {
  constexpr std::size_t kOfLand = 7;
  std::map<double, double> noise;  // by the band's centre
  for (const io::PresetBand& band : std::span(io::sensor_preset("MODIS").bands).first(kOfLand))
    noise[0.5 * (band.a_um + band.b_um)] = band.at_w_m2_sr_um / band.snr;
  const auto next = noise.lower_bound(wavelength_um);
  if (next == noise.begin()) return next->second;
  const auto before = std::prev(next);
  if (next == noise.end()) return before->second;
  return std::lerp(before->second, next->second,
                   (wavelength_um - before->first) / (next->first - before->first));
}

io::Document with_noise(io::Document document, const std::vector<double>& noise) {
  for (std::size_t c = 0; c < noise.size(); ++c) {
    io::ChannelDocument& channel = document.sensor.channels[c];
    channel.noise.emplace();
    channel.noise->source = io::ConstantSpectrum{noise[c]};
    channel.noise->quantity = io::SpectrumOf::radiance;
    channel.noise_k.reset();
    channel.snr.reset();
  }
  return document;
}

/// Of all threads together.
double seconds_since(std::clock_t before) {
  return static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
}

OverSeeds over_seeds(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  OverSeeds out{std::accumulate(values.begin(), values.end(), 0.0) / n, kNone};
  if (values.size() < 2) return out;
  double squares = 0.0;
  for (const double value : values) squares += (value - out.mean) * (value - out.mean);
  out.standard_error = std::sqrt(squares / (n * (n - 1.0)));
  return out;
}

/// Renders ways of sampling with several seeds and holds them against the reference.
class Curves {
 public:
  Curves(const ImageStore& reference, const RadianceErrors& ten, const StudyOptions& options, int seeds)
      : reference_(reference), ten_(ten), options_(options), seeds_(seeds) {}

  CurvePoint point(const SceneRenderer& scene, const SamplingWay& way) const {
    CurvePoint out;
    out.name = way.name;
    out.seconds = std::numeric_limits<double>::infinity();
    out.stated_low = out.stated_high = out.coverage = kNone;
    std::vector<double> mean, worst, tail_99, tail_999, coverage;
    std::vector<double> squares, stated;  // over seeds, by channel
    for (int seed = 0; seed < seeds_; ++seed) {
      if (options_.log != nullptr) options_.log->info(format("{}, {} of {}", way.name, seed + 1, seeds_));
      ImageStore image;
      SceneRenderer::Choices choices{options_.threads, 64, {}, options_.cancel, options_.progress};
      choices.seed = options_.seed + 100 + static_cast<std::uint64_t>(seed);
      const std::clock_t before = std::clock();
      scene.render(way.sampling, choices, image);
      out.seconds = std::min(out.seconds, seconds_since(before));
      const double pixels = static_cast<double>(image.samples().size());
      out.samples_per_px += static_cast<double>(image.cost().samples) / pixels / seeds_;
      out.rays_per_px += static_cast<double>(image.cost().rays.total()) / pixels / seeds_;
      const RadianceErrors errors = radiance_errors(image, reference_);
      const ErrorRatios ratios = error_ratios(errors, ten_);
      mean.push_back(ratios.mean);
      worst.push_back(ratios.worst);
      tail_99.push_back(error_quantile(image, reference_, ten_, 0.99));
      tail_999.push_back(error_quantile(image, reference_, ten_, 0.999));
      coverage.push_back(errors.coverage);
      squares.resize(errors.rms.size());
      stated.resize(errors.rms.size());
      const std::vector<double> of_image = image.stated_rms();
      for (std::size_t c = 0; c < errors.rms.size(); ++c) {
        squares[c] += errors.rms[c] * errors.rms[c];
        if (!of_image.empty()) stated[c] += of_image[c] * of_image[c];
      }
    }
    out.mean_band = over_seeds(mean);
    out.worst_band = over_seeds(worst);
    out.tail_99 = over_seeds(tail_99);
    out.tail_999 = over_seeds(tail_999);
    out.coverage = over_seeds(coverage).mean;
    for (std::size_t c = 0; c < squares.size(); ++c) {
      if (!(stated[c] > 0.0) || !counts(ten_, c)) continue;
      const double ratio = std::sqrt(stated[c] / squares[c]);
      if (!(out.stated_low <= ratio)) out.stated_low = ratio;
      if (!(out.stated_high >= ratio)) out.stated_high = ratio;
    }
    return out;
  }

 private:
  const ImageStore& reference_;
  const RadianceErrors& ten_;
  const StudyOptions& options_;
  int seeds_;
};

void add_figures(ImageCurves& out) {
  FigureTable& f = out.figures;
  const CurvePoint& ten = *std::find_if(out.grids.begin(), out.grids.end(),
                                        [](const CurvePoint& p) { return p.name == grid_way(10).name; });
  const CurvePoint& at_one = *std::find_if(out.ours.begin(), out.ours.end(), [](const CurvePoint& p) {
    return p.name == image_way(kJudgedLimit).name;
  });
  f.at_least(
      "image_less_time_than_grid_10",
      seconds_at_one(out.grids, &CurvePoint::mean_band) / seconds_at_one(out.ours, &CurvePoint::mean_band),
      2.5, "times",
      "processor time of grids over that of an error of the image, at the mean-band RMS error of the grid 10 x 10");
  f.at_least(
      "image_less_time_by_worst_band",
      seconds_at_one(out.grids, &CurvePoint::worst_band) / seconds_at_one(out.ours, &CurvePoint::worst_band),
      2.0, "times", "the same at its RMS error in the worst band");
  f.report("image_fewer_rays_by_mean_band", ten.rays_per_px / at_one.rays_per_px, "times",
           format("rays of the grid 10 x 10 over those of the setting '{}'", at_one.name));
  f.report("image_rms_over_grid_10", at_one.mean_band.mean, "",
           format("{}: RMS error over that of the grid 10 x 10, mean band; {:.3f} in the worst", at_one.name,
                  at_one.worst_band.mean));
  f.report("image_tail_999_over_grid_10", at_one.tail_999.mean / ten.tail_999.mean, "",
           "its |error| that 99.9 % of pixels stay below, over that of the grid 10 x 10");
  f.at_least("image_stated_over_true_least", at_one.stated_low, 0.85, "",
             "stated over true RMS error over the image, in the channel where that is least; over all seeds");
  f.at_most("image_stated_over_true_most", at_one.stated_high, 1.15, "", "the same where it is most");
  f.report("image_coverage", at_one.coverage, "", "share of its half-widths that hold the reference");
  f.report("audited_image_less_time_than_grid_10", out.audited_grid.seconds / out.audited_ours.seconds,
           "times", format("processor time of '{}' over '{}'", out.audited_grid.name, out.audited_ours.name));
  f.report("audited_image_coverage", out.audited_ours.coverage, "",
           "share of the audited half-widths that hold the reference, whose own intervals are wide");
  if (std::isfinite(out.instrument.seconds))
    f.report(
        "image_at_modis_noise_seconds", out.instrument.seconds, "s",
        format(
            "processor time of an RMS error over the image within the noise of MODIS in every channel; stated {:.2f} of it",
            out.instrument_stated));
}

}  // namespace

double seconds_at_one(const std::vector<CurvePoint>& curve, OverSeeds CurvePoint::*error) {
  if (curve.size() < 2) return kNone;
  std::size_t next = 1;  // the first point that is within, or the last
  while (next + 1 < curve.size() && (curve[next].*error).mean > 1.0) ++next;
  const CurvePoint &a = curve[next - 1], &b = curve[next];
  const double from = std::log((a.*error).mean), to = std::log((b.*error).mean);
  const double share = from / (from - to);
  return std::exp(std::log(a.seconds) + share * (std::log(b.seconds) - std::log(a.seconds)));
}

ImageCurves image_curves(const io::Document& document, const ImageStore& reference, const RadianceErrors& ten,
                         const StudyOptions& options, bool quick) {
  ImageCurves out;
  out.seeds = quick ? 1 : kSeeds;
  constexpr double kFalls = 0.575;  // of the RMS error of a grid, with its samples
  const auto samples = *std::max_element(reference.samples().begin(), reference.samples().end());
  out.reference_error = std::pow(100.0 / static_cast<double>(samples), kFalls);
  std::vector<double> noise(ten.rms.size());
  for (std::size_t c = 0; c < noise.size(); ++c) noise[c] = counts(ten, c) ? ten.rms[c] : ten.mean[c];
  const SceneRenderer scene(with_noise(document, noise), options.log);
  const Curves curves(reference, ten, options, out.seeds);
  for (const int n : quick ? std::span<const int>(kQuickGrids) : std::span<const int>(kGrids))
    out.grids.push_back(curves.point(scene, grid_way(n)));
  for (const double limit : quick ? std::span<const double>(kQuickLimits) : std::span<const double>(kLimits))
    out.ours.push_back(curves.point(scene, image_way(limit)));
  out.audited_grid = curves.point(scene, grid_way(10, kAudited));
  out.audited_ours = curves.point(scene, image_way(kJudgedLimit, kAudited));
  out.instrument.seconds = kNone;
  if (!quick) {
    for (std::size_t c = 0; c < noise.size(); ++c) noise[c] = modis_noise(scene.info().channels[c].centre_um);
    const SceneRenderer fine(with_noise(document, noise), options.log);
    ImageStore image;
    SamplingWay way = image_way(1.0);
    if (options.log != nullptr) options.log->info("image, at the noise of MODIS");
    out.instrument.name = way.name;
    const std::clock_t before = std::clock();
    fine.render(way.sampling, {options.threads, 64, {}, options.cancel, options.progress, options.seed + 100},
                image);
    out.instrument.seconds = seconds_since(before);
    const std::vector<double> stated = image.stated_rms();
    for (std::size_t c = 0; c < stated.size(); ++c)
      out.instrument_stated = std::max(out.instrument_stated, stated[c] / noise[c]);
  }
  add_figures(out);
  return out;
}

}  // namespace ifov::studies
