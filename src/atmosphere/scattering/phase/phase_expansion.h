#pragma once

#include <vector>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/scattering/phase/phase_function.h"

namespace ifov::atmosphere {

struct ScatteringMatrix;

/// Expansion coefficients ("Greek constants", Siewert 2000) of a scattering matrix in generalised spherical
/// functions, for l = 0 .. count - 1:
///   a1 = sum beta d^l_00,  a2 + a3 = sum (alpha + zeta) d^l_22,  a2 - a3 = sum (alpha - zeta) d^l_2,-2,
///   b1 = sum gamma d^l_02.
/// beta_0 = 1.
struct PhaseExpansion {
  std::vector<double> beta, alpha, zeta, gamma;
};

/// Closed form; nothing beyond l = 2.
PhaseExpansion rayleigh_expansion(int count, double depolarization);

/// Projects aerosol_matrix onto the functions; the grid of angles is made once. Constant after construction. `count` is
/// at most PhaseAngles::kMoments - 1.
class AerosolProjection {
 public:
  AerosolProjection(int count, double peak_polarization);
  /// Of a Henyey-Greenstein function.
  PhaseExpansion expansion(double asymmetry) const;
  PhaseExpansion expansion(const PhaseFunction& function) const;

 private:
  void add_angle(const ScatteringMatrix& matrix, double weight, const double* d02, const double* d22,
                 const double* d2m2, PhaseExpansion& expansion) const;

  int count_;
  double peak_polarization_;
  std::vector<double> cosine_, weight_;
  std::vector<double> d02_, d22_, d2m2_;  ///< [angle][l]
};

}  // namespace ifov::atmosphere
