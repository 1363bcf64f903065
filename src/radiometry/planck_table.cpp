#include "radiometry/planck_table.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ifov::radiometry {
namespace {

constexpr double kTolerance = 1e-5;
constexpr double kDark_w_m2_sr_um = 1e-6;
constexpr double kFirstStep = 0.03;  // of ln T
constexpr double kNothing = 1e-30;   // denormal floats would slow every row
constexpr std::size_t kMostTemperatures = 8193;

}  // namespace

PlanckTable::PlanckTable(const SpectralNodes& nodes, double t_low_k, double t_high_k)
    : t_low_k_(t_low_k), t_high_k_(t_high_k) {
  if (!(t_low_k > 0.0) || !(t_high_k > t_low_k))
    throw InputError(format("temperatures from {:g} K to {:g} K make no table", t_low_k, t_high_k));
  std::size_t intervals = 1 + static_cast<std::size_t>(std::log(t_high_k / t_low_k) / kFirstStep);
  fill(nodes, intervals + 1);
  while (worst_error(nodes) > kTolerance) {
    intervals *= 2;
    if (intervals >= kMostTemperatures)
      throw InputError(format("temperatures from {:g} K to {:g} K cannot be tabulated within {:g}", t_low_k,
                              t_high_k, kTolerance));
    fill(nodes, intervals + 1);
  }
}

void PlanckTable::fill(const SpectralNodes& nodes, std::size_t count) {
  step_ = std::log(t_high_k_ / t_low_k_) / static_cast<double>(count - 1);
  values_.resize(count, nodes.node_count());
  slopes_.resize(count, nodes.node_count());
  std::vector<double> below(nodes.node_count()), above(nodes.node_count());
  for (std::size_t i = 0; i < count; ++i) {
    const double temperature = t_low_k_ * std::exp(static_cast<double>(i) * step_);
    nodes.planck(temperature, values_.values(i));
    // A central difference over 1e-4 of T: its error is far below what the interpolation needs.
    constexpr double kDelta = 1e-4;
    nodes.planck(temperature * (1.0 - kDelta), std::span<double>(below));
    nodes.planck(temperature * (1.0 + kDelta), std::span<double>(above));
    for (std::size_t n = 0; n < below.size(); ++n) {
      const double slope = step_ * (above[n] - below[n]) / (2.0 * kDelta);
      slopes_.row(i)[n] = slope < kNothing ? 0.0f : static_cast<float>(slope);
    }
  }
}

double PlanckTable::worst_error(const SpectralNodes& nodes) const {
  std::vector<double> exact(nodes.node_count());
  SpectrumBlock interpolated(1, nodes.node_count());
  double worst = 0.0;
  for (std::size_t i = 0; i + 1 < temperature_count(); ++i) {
    const double temperature = t_low_k_ * std::exp((static_cast<double>(i) + 0.5) * step_);
    nodes.planck(temperature, std::span<double>(exact));
    row(temperature, interpolated.row(0));
    for (std::size_t n = 0; n < exact.size(); ++n)
      worst =
          std::max(worst, std::abs(interpolated.row(0)[n] - exact[n]) / std::max(exact[n], kDark_w_m2_sr_um));
  }
  return worst;
}

void PlanckTable::row(double temperature_k, float* nodes) const {
  const double position = std::log(std::clamp(temperature_k, t_low_k_, t_high_k_) / t_low_k_) / step_;
  const std::size_t low = std::min(static_cast<std::size_t>(position), temperature_count() - 2);
  const float s = static_cast<float>(position - static_cast<double>(low));
  const float r = 1.0f - s;
  const float value0 = r * r * (1.0f + 2.0f * s), value1 = s * s * (1.0f + 2.0f * r);
  const float slope0 = s * r * r, slope1 = -s * s * r;
  const float* __restrict v0 = values_.row(low);
  const float* __restrict v1 = values_.row(low + 1);
  const float* __restrict d0 = slopes_.row(low);
  const float* __restrict d1 = slopes_.row(low + 1);
  float* __restrict out = nodes;
  for (std::size_t n = 0; n < values_.stride(); ++n)
    out[n] = value0 * v0[n] + value1 * v1[n] + slope0 * d0[n] + slope1 * d1[n];
}

}  // namespace ifov::radiometry
