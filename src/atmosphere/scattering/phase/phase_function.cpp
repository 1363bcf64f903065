#include "atmosphere/scattering/phase/phase_function.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/scattering/phase/scattering_matrix.h"
#include "atmosphere/scattering/phase/spherical_functions.h"

namespace ifov::atmosphere {

PhaseAngles::PhaseAngles(std::vector<double> angles) : angle_rad(std::move(angles)) {
  constexpr double kRounding_rad = 1e-9;
  if (angle_rad.size() < 4 || angle_rad.front() != 0.0 ||
      std::abs(angle_rad.back() - std::numbers::pi) > kRounding_rad ||
      std::adjacent_find(angle_rad.begin(), angle_rad.end(), std::greater_equal<>()) != angle_rad.end())
    throw std::invalid_argument("scattering angles must rise from 0 to 180 degrees, four at least");
  const GaussNodes peak = gauss_nodes(kPeakNodes), step = gauss_nodes(8);
  for (std::size_t i = 0; i + 1 < angle_rad.size(); ++i) {
    const double width = angle_rad[i + 1] - angle_rad[i];
    const GaussNodes& gauss = i == 0 ? peak : step;
    for (std::size_t k = 0; k < gauss.position.size(); ++k) {
      const double u = gauss.position[k], position = i == 0 ? u * u * u : u;
      const double angle = angle_rad[i] + width * position;
      const double weight = gauss.weight[k] * width * (i == 0 ? 3.0 * u * u : 1.0);
      nodes.push_back({i, position, std::cos(angle), 0.5 * weight * std::sin(angle)});
    }
  }
  for (const Node& node : nodes)
    for (auto [table, m, n] : {std::tuple{&d00, 0, 0}, {&d02, 0, 2}, {&d22, 2, 2}, {&d2m2, 2, -2}}) {
      const std::vector<double> d = wigner_d(m, n, kMoments, node.cosine);
      table->insert(table->end(), d.begin(), d.end());
    }
}

PolarizationRatios PolarizationRatios::none(std::span<const double> angle_rad) {
  PolarizationRatios ratios;
  for (const double angle : angle_rad) {
    const ScatteringMatrix matrix = particle_matrix(std::cos(angle), 1.0, 0.0);
    ratios.a2.push_back(matrix.a2);
    ratios.a3.push_back(matrix.a3);
    ratios.b1.push_back(0.0);
  }
  return ratios;
}

PhaseFunction::PhaseFunction(std::shared_ptr<const PhaseAngles> angles, std::vector<double> logarithms,
                             std::shared_ptr<const PolarizationRatios> polarization)
    : angles_(std::move(angles)), logarithms_(std::move(logarithms)), polarization_(std::move(polarization)) {
  const std::size_t count = angles_->angle_rad.size();
  if (logarithms_.size() != count ||
      (polarization_ && (polarization_->a2.size() != count || polarization_->a3.size() != count ||
                         polarization_->b1.size() != count)))
    throw std::invalid_argument("a phase function has one value an angle");
  set_slopes();
  at_nodes_.assign(angles_->nodes.size(), 0.0);
  double mean = 0.0;
  for (std::size_t k = PhaseAngles::kPeakNodes; k < at_nodes_.size(); ++k) {
    const PhaseAngles::Node& node = angles_->nodes[k];
    at_nodes_[k] = std::exp(logarithm(node.step, node.position));
    mean += node.weight * at_nodes_[k];
  }
  peak_exponent_ = fitted_exponent(1.0 - mean);
  for (std::size_t k = 0; k < PhaseAngles::kPeakNodes; ++k) {
    const PhaseAngles::Node& node = angles_->nodes[k];
    at_nodes_[k] = std::exp(logarithm(node.step, node.position));
    mean += node.weight * at_nodes_[k];
  }
  if (!(mean > 0.0 && std::isfinite(mean)))
    throw std::invalid_argument("a phase function must have a finite mean above 0");
  given_mean_ = mean;
  for (double& value : at_nodes_) value /= mean;
  for (double& value : logarithms_) value -= std::log(mean);
  set_moments();
}

void PhaseFunction::set_slopes() {
  const std::vector<double>& angle = angles_->angle_rad;
  const std::size_t last = angle.size() - 1;
  slope_.assign(angle.size(), 0.0);
  const auto step = [&](std::size_t i) { return angle[i + 1] - angle[i]; };
  const auto chord = [&](std::size_t i) { return (logarithms_[i + 1] - logarithms_[i]) / step(i); };
  slope_[1] = chord(1);
  slope_[last] = chord(last - 1);
  for (std::size_t i = 2; i < last; ++i) {
    const double before = chord(i - 1), after = chord(i);
    if (!(before * after > 0.0)) continue;
    const double a = 2.0 * step(i) + step(i - 1), b = step(i) + 2.0 * step(i - 1);
    slope_[i] = (a + b) / (a / before + b / after);
  }
}

/// What the first step adds to the mean.
double PhaseFunction::peak_mean(double exponent) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < PhaseAngles::kPeakNodes; ++k) {
    const PhaseAngles::Node& node = angles_->nodes[k];
    sum +=
        node.weight * std::exp(std::lerp(logarithms_[0], logarithms_[1], std::pow(node.position, exponent)));
  }
  return sum;
}

double PhaseFunction::fitted_exponent(double mean) const {
  constexpr double kGaussian = 2.0, kNarrowest = 0.25, kWidest = 6.0;
  constexpr int kHalvings = 16;  // to 1e-4
  if (!(logarithms_[0] > logarithms_[1] && peak_mean(kNarrowest) < mean && mean < peak_mean(kWidest)))
    return kGaussian;
  double low = kNarrowest, high = kWidest;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (peak_mean(middle) < mean ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double PhaseFunction::logarithm(std::size_t step, double u) const {
  const double low = logarithms_[step], high = logarithms_[step + 1];
  if (step == 0) return low + (high - low) * std::pow(u, peak_exponent_);
  const double width = angles_->angle_rad[step + 1] - angles_->angle_rad[step], v = 1.0 - u;
  return low * (1.0 + 2.0 * u) * v * v + high * u * u * (3.0 - 2.0 * u) +
         width * (slope_[step] * u * v * v - slope_[step + 1] * u * u * v);
}

PhaseFunction::Place PhaseFunction::place(double cosine) const {
  const std::vector<double>& angle = angles_->angle_rad;
  const double at = std::acos(std::clamp(cosine, -1.0, 1.0));
  const std::size_t above =
      static_cast<std::size_t>(std::upper_bound(angle.begin(), angle.end(), at) - angle.begin());
  const std::size_t step = std::clamp<std::size_t>(above, 1, angle.size() - 1) - 1;
  return {step, std::clamp((at - angle[step]) / (angle[step + 1] - angle[step]), 0.0, 1.0)};
}

double PhaseFunction::at(double cosine) const {
  const Place here = place(cosine);
  return std::exp(logarithm(here.step, here.position));
}

ScatteringMatrix PhaseFunction::matrix(const Place& here, double cosine, double a1,
                                       double peak_polarization) const {
  if (!polarization_) return particle_matrix(cosine, a1, peak_polarization);
  const auto ratio = [&](const std::vector<double>& of) {
    return a1 * std::lerp(of[here.step], of[here.step + 1], here.position);
  };
  return {a1, ratio(polarization_->a2), ratio(polarization_->a3), ratio(polarization_->b1)};
}

ScatteringMatrix PhaseFunction::matrix(double cosine, double peak_polarization) const {
  const Place here = place(cosine);
  return matrix(here, cosine, std::exp(logarithm(here.step, here.position)), peak_polarization);
}

ScatteringMatrix PhaseFunction::matrix_at_node(std::size_t node, double peak_polarization) const {
  const PhaseAngles::Node& at = angles_->nodes[node];
  return matrix({at.step, at.position}, at.cosine, at_nodes_[node], peak_polarization);
}

double PhaseFunction::forward_for(double width, double height) const {
  static const GaussNodes gauss = gauss_nodes(12);
  // Cubes of the nodes: close to one another at the forward direction.
  const auto place = [](double u) { return u * u * u; };
  const auto share = [&](std::size_t k) { return 3.0 * gauss.weight[k] * std::pow(gauss.position[k], 2); };
  double mean = 0.0;
  for (std::size_t i = 0; i < gauss.position.size(); ++i)
    for (std::size_t j = 0; j < gauss.position.size(); ++j) {
      const double x = width * place(gauss.position[i]), y = height * place(gauss.position[j]);
      mean += share(i) * share(j) * at(std::cos(std::hypot(x, y)));
    }
  const double beside = at(std::cos(width)), above = at(std::cos(height)),
               across = at(std::cos(std::hypot(width, height)));
  return std::max({4.0 * mean - beside - above - across, beside, above});
}

void PhaseFunction::set_moments() {
  moments_.assign(PhaseAngles::kMoments, 0.0);
  for (std::size_t k = 0; k < at_nodes_.size(); ++k) {
    const double light = angles_->nodes[k].weight * at_nodes_[k];
    const double* d = angles_->d00.data() + k * PhaseAngles::kMoments;
    for (std::size_t l = 0; l < moments_.size(); ++l) moments_[l] += light * d[l];
  }
}

double AerosolPhases::moment(std::size_t layer, int l) const {
  double sum = 0.0;
  for (std::size_t f = 0; f < functions.size(); ++f)
    if (shares(layer)[f] > 0.0) sum += shares(layer)[f] * functions[f].moment(l);
  return sum;
}

}  // namespace ifov::atmosphere
