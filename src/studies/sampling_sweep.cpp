#include "studies/sampling_sweep.h"

#include <cmath>
#include <functional>
#include <limits>

#include "core/parallel.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "studies/common/study_document.h"

namespace ifov::studies {

namespace {

std::vector<SweepPoint> sweep(const std::vector<double>& settings,
                              const std::function<io::SamplingDocument(double)>& sampling_of,
                              const std::filesystem::path& folder, const StudyOptions& options,
                              StudyProgress& progress) {
  std::vector<SweepPoint> points(settings.size());
  const ThermalScene scene = dome_scene(paper_dome());
  // Longest first, so that no thread is left with the largest at the end.
  parallel_for(static_cast<std::int64_t>(settings.size()), options.threads, [&](std::int64_t k) {
    const std::size_t at = settings.size() - 1 - static_cast<std::size_t>(k);
    points[at].setting = settings[at];
    points[at].trial = render_thermal(scene, sampling_of(settings[at]), options.seed, folder, options.cancel);
    progress.add(9, points[at].trial.cost.rays.total());
  });
  return points;
}

std::vector<double> even_numbers(int largest) {
  std::vector<double> numbers;
  for (int n = 2; n <= largest; n += 2) numbers.push_back(n);
  return numbers;
}

}  // namespace

io::SamplingDocument paper_adaptive(int n) {
  return adaptive_sampling(n / 2, n * n, radiance_of_error(0.01));
}

std::vector<SweepPoint> grid_sweep(int largest, const std::filesystem::path& folder,
                                   const StudyOptions& options, StudyProgress& progress) {
  return sweep(
      even_numbers(largest), [](double n) { return grid_sampling(static_cast<int>(n)); }, folder, options,
      progress);
}

std::vector<SweepPoint> adaptive_sweep(int largest, const std::filesystem::path& folder,
                                       const StudyOptions& options, StudyProgress& progress) {
  return sweep(
      even_numbers(largest), [](double n) { return paper_adaptive(static_cast<int>(n)); }, folder, options,
      progress);
}

std::vector<SweepPoint> accuracy_sweep(const std::vector<double>& errors_c,
                                       const std::filesystem::path& folder, const StudyOptions& options,
                                       StudyProgress& progress) {
  return sweep(
      errors_c, [](double error) { return accuracy_sampling(radiance_of_error(error)); }, folder, options,
      progress);
}

double samples_that_stay_within(const std::vector<SweepPoint>& points, double tolerance_c) {
  double samples = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = points.size(); k-- > 0 && std::abs(points[k].trial.error_c) <= tolerance_c;)
    samples = static_cast<double>(points[k].trial.cost.samples);
  return samples;
}

}  // namespace ifov::studies
