#include "atmosphere/scattering/phase/phase_expansion.h"

#include <cmath>
#include <utility>

#include "atmosphere/scattering/phase/scattering_matrix.h"
#include "atmosphere/scattering/phase/spherical_functions.h"

namespace ifov::atmosphere {

namespace {

/// Enough for Henyey-Greenstein functions up to g = 0.95 and two dozen coefficients.
constexpr int kAngles = 128;

PhaseExpansion empty_expansion(int count) {
  const std::vector<double> none(count, 0.0);
  return {none, none, none, none};
}

}  // namespace

PhaseExpansion rayleigh_expansion(int count, double depolarization) {
  PhaseExpansion expansion = empty_expansion(count);
  const double c = (1.0 - depolarization) / (2.0 + depolarization);
  expansion.beta[0] = 1.0;
  if (count <= 2) return expansion;
  expansion.beta[2] = c;
  expansion.alpha[2] = 6.0 * c;
  expansion.gamma[2] = -std::sqrt(6.0) * c;
  return expansion;
}

AerosolProjection::AerosolProjection(int count, double peak_polarization)
    : count_(count), peak_polarization_(peak_polarization) {
  const GaussNodes nodes = gauss_nodes(kAngles);
  for (int i = 0; i < kAngles; ++i) {
    const double x = 2.0 * nodes.position[i] - 1.0;
    cosine_.push_back(x);
    weight_.push_back(2.0 * nodes.weight[i]);
    for (auto [table, n] : {std::pair{&d02_, 0}, {&d22_, 2}, {&d2m2_, -2}}) {
      const std::vector<double> d = n == 0 ? wigner_d(0, 2, count, x) : wigner_d(2, n, count, x);
      table->insert(table->end(), d.begin(), d.end());
    }
  }
}

void AerosolProjection::add_angle(const ScatteringMatrix& matrix, double weight, const double* d02,
                                  const double* d22, const double* d2m2, PhaseExpansion& expansion) const {
  for (int l = 0; l < count_; ++l) {
    const double scale = 0.5 * (2.0 * l + 1.0) * weight;
    const double sum = scale * (matrix.a2 + matrix.a3) * d22[l];
    const double difference = scale * (matrix.a2 - matrix.a3) * d2m2[l];
    expansion.alpha[l] += 0.5 * (sum + difference);
    expansion.zeta[l] += 0.5 * (sum - difference);
    expansion.gamma[l] += scale * matrix.b1 * d02[l];
  }
}

PhaseExpansion AerosolProjection::expansion(double asymmetry) const {
  PhaseExpansion expansion = empty_expansion(count_);
  for (int angle = 0; angle < kAngles; ++angle) {
    const std::size_t at = static_cast<std::size_t>(angle) * count_;
    add_angle(aerosol_matrix(cosine_[angle], asymmetry, peak_polarization_), weight_[angle], &d02_[at],
              &d22_[at], &d2m2_[at], expansion);
  }
  double power = 1.0;
  for (int l = 0; l < count_; ++l) {
    expansion.beta[l] = (2.0 * l + 1.0) * power;
    power *= asymmetry;
  }
  return expansion;
}

PhaseExpansion AerosolProjection::expansion(const PhaseFunction& function) const {
  PhaseExpansion expansion = empty_expansion(count_);
  const PhaseAngles& angles = function.angles();
  for (std::size_t k = 0; k < angles.nodes.size(); ++k) {
    const std::size_t at = k * PhaseAngles::kMoments;
    add_angle(function.matrix_at_node(k, peak_polarization_), 2.0 * angles.nodes[k].weight, &angles.d02[at],
              &angles.d22[at], &angles.d2m2[at], expansion);
  }
  for (int l = 0; l < count_; ++l) expansion.beta[l] = (2.0 * l + 1.0) * function.moment(l);
  return expansion;
}

}  // namespace ifov::atmosphere
