#include "atmosphere/thermal/scattered_emission.h"

#include <algorithm>
#include <utility>

#include "atmosphere/layer_optics.h"
#include "atmosphere/thermal/thermal_scattering.h"
#include "radiometry/planck.h"

namespace ifov::atmosphere {

ScatteredEmission::ScatteredEmission(const Levels& levels, std::vector<Question> questions,
                                     const ScatteringOptions& options)
    : levels_(levels), questions_(std::move(questions)), options_(options) {
  const auto scatters = [](const Question& question) { return scatters_own_light(question.optics); };
  if (std::none_of(questions_.begin(), questions_.end(), scatters)) return;
  parts_.assign(levels.layers(), 1);
  for (const Question& question : questions_) {
    const std::vector<int> parts = ThermalScattering::parts(levels, question.optics, options_);
    for (std::size_t layer = 0; layer < parts.size(); ++layer)
      parts_[layer] = std::max(parts_[layer], parts[layer]);
  }
  solved_.resize(questions_.size());
}

ScatteredEmission::~ScatteredEmission() = default;
ScatteredEmission::ScatteredEmission(ScatteredEmission&&) noexcept = default;

std::size_t ScatteredEmission::solutions() const { return solved_.size(); }

void ScatteredEmission::solve(std::size_t solution) {
  const Question& question = questions_[solution];
  std::vector<double> planck;
  for (const double kelvin : levels_.temperature_K)
    planck.push_back(radiometry::planck_w_m2_sr_um(question.wavelength_um, kelvin));
  solved_[solution].emplace(levels_, question.optics, planck, parts_, options_);
}

std::span<const double> ScatteredEmission::altitude_km() const { return solved_.front()->altitude_km(); }

std::vector<double> ScatteredEmission::scattering_depth(std::span<const double> share) const {
  std::vector<double> sum(solved_.front()->scattering_depth().size(), 0.0);
  for (std::size_t k = 0; k < solved_.size(); ++k)
    if (share[k] != 0.0)
      for (std::size_t s = 0; s < sum.size(); ++s) sum[s] += share[k] * solved_[k]->scattering_depth()[s];
  for (double& depth : sum) depth = std::max(0.0, depth);
  return sum;
}

ScatteredEmission::Ring ScatteredEmission::ring(double mu) const {
  Ring ring;
  for (const std::optional<ThermalScattering>& solved : solved_) {
    std::vector<double>& sources = ring.emplace_back(solved->scattered(mu));
    for (std::size_t s = 0; s < sources.size() / 2; ++s)
      for (std::size_t end = 0; end < 2; ++end) sources[2 * s + end] /= solved->planck()[s + end];
  }
  return ring;
}

void ScatteredEmission::mix(const Ring& ring, std::span<const double> share, std::span<const double> planck,
                            std::vector<double>& scattered) {
  scattered.assign(ring.front().size(), 0.0);
  for (std::size_t k = 0; k < ring.size(); ++k)
    if (share[k] != 0.0)
      for (std::size_t i = 0; i < scattered.size(); ++i) scattered[i] += share[k] * ring[k][i];
  for (std::size_t s = 0; s < scattered.size() / 2; ++s) {
    scattered[2 * s] = std::max(0.0, scattered[2 * s] * planck[s]);
    scattered[2 * s + 1] = std::max(0.0, scattered[2 * s + 1] * planck[s + 1]);
  }
}

}  // namespace ifov::atmosphere
