#include "studies/thermal_trials.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "io/document/document.h"
#include "sampling/random.h"
#include "studies/common/image_store.h"
#include "studies/common/study_document.h"
#include "studies/common/study_rendering.h"

namespace ifov::studies {

namespace {

/// Floats store radiance to this share of itself; an interval narrower than that is met by equality.
constexpr double kStorage = 1e-6;

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double at = share * (static_cast<double>(values.size()) - 1.0);
  return values[static_cast<std::size_t>(std::ceil(at))];
}

}  // namespace

ThermalTrial render_thermal(const ThermalScene& scene, const io::SamplingDocument& sampling,
                            std::uint64_t seed, const std::filesystem::path& folder,
                            const CancelToken* cancel) {
  ImageStore image;
  render_document(study_text(scene.document(sampling, seed)), folder, {1, cancel, nullptr, {}}, image);
  const std::size_t centre = image.index(1, 1);
  ThermalTrial trial;
  trial.radiance = static_cast<double>(image.mean()[centre]);
  trial.error_c = error_c(trial.radiance - scene.truth);
  trial.half_width_c = error_c(static_cast<double>(image.half_width()[centre]));
  trial.target_seen = scene.hot_fraction == 0.0 || trial.radiance > cold_radiance() * (1.0 + kStorage);
  trial.cost = image.cost();
  return trial;
}

TrialSummary run_series(const TrialSeries& series, const TextureMap& texture,
                        const std::filesystem::path& folder, const StudyOptions& options,
                        StudyProgress& progress) {
  std::vector<ThermalTrial> trials(static_cast<std::size_t>(options.trials));
  parallel_for(options.trials, options.threads, [&](std::int64_t k) {
    const ThermalScene scene = random_scene(series.family, options.seed, static_cast<int>(k), texture);
    // Documents keep seeds of 53 bits.
    const std::uint64_t seed = sampling::hash(options.seed, k) >> 11;
    ThermalTrial& trial = trials[static_cast<std::size_t>(k)];
    trial = render_thermal(scene, series.sampling, seed, folder, options.cancel);
    progress.add(9, trial.cost.rays.total());
  });

  TrialSummary summary;
  summary.trials = options.trials;
  std::vector<double> samples;
  int held = 0, seen = 0;
  for (const ThermalTrial& trial : trials) {
    samples.push_back(static_cast<double>(trial.cost.samples));
    summary.mean_samples += samples.back() / options.trials;
    summary.mean_cost_total += trial.cost;
    summary.rms_c += trial.error_c * trial.error_c / options.trials;
    held += std::abs(trial.error_c) <= trial.half_width_c + error_c(kStorage * trial.radiance);
    seen += trial.target_seen;
    summary.absolute_error_c.push_back(std::abs(trial.error_c));
  }
  summary.coverage = static_cast<double>(held) / options.trials;
  summary.seen = static_cast<double>(seen) / options.trials;
  summary.rms_c = std::sqrt(summary.rms_c);
  summary.samples_95 = quantile(samples, 0.95);
  summary.error_95_c = quantile(summary.absolute_error_c, 0.95);
  return summary;
}

double TrialSummary::within(double tolerance_c) const {
  const auto met = std::count_if(absolute_error_c.begin(), absolute_error_c.end(),
                                 [&](double e) { return e <= tolerance_c; });
  return static_cast<double>(met) / static_cast<double>(absolute_error_c.size());
}

}  // namespace ifov::studies
