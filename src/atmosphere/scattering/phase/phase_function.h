#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace ifov::atmosphere {

struct ScatteringMatrix;

/// Scattering angles at which phase functions are tabulated, with nodes for integrals over the sphere: 24 in the
/// first step, closest at 0, where a diffraction peak may be, and 8 in each other. Constant after construction.
class PhaseAngles {
 public:
  static constexpr int kMoments = 49;  ///< l = 0 .. 48: what delta-M of 24 nodes per hemisphere asks for

  static constexpr int kPeakNodes = 24;  ///< in the first step, the first of `nodes`

  /// Radians, from 0 to pi, rising. Throws std::invalid_argument for others.
  explicit PhaseAngles(std::vector<double> angle_rad);

  struct Node {
    std::size_t step = 0;   ///< between angles `step` and `step` + 1 ...
    double position = 0.0;  ///< ... at this share of it
    double cosine = 1.0;
    double weight = 0.0;  ///< of means over the sphere: the weights add up to 1
  };
  std::vector<double> angle_rad;
  std::vector<Node> nodes;
  /// Wigner's d^l_00 (Legendre's polynomials), d^l_02, d^l_22 and d^l_2,-2 at the nodes: [node][l].
  std::vector<double> d00, d02, d22, d2m2;
};

/// How particles polarize light that they scatter: elements of the scattering matrix over a1, one an angle of the phase function, linear in between.
struct PolarizationRatios {
  std::vector<double> a2, a3, b1;
  /// Of particles that polarize nothing, at these angles: light that comes in polarized keeps that as from molecules, and all of it straight
  /// ahead. Did it lose that there, too, what is left without the forward peak would take more polarization away than there is.
  static PolarizationRatios none(std::span<const double> angle_rad);
};

/// A phase function from a table of its logarithm: monotone cubics in the angle (Fritsch and Butland 1984), and in the
/// first step, where tables do not tell how wide a diffraction peak is,   ln P = ln P_0 + ln(P_1 / P_0) (angle / angle_1)^q
/// with the q (0.25 to 6) that makes the mean over the sphere 1. Where none does, or P_0 is not above P_1, q = 2 and the function is scaled.
class PhaseFunction {
 public:
  /// One logarithm an angle, of a function whose mean is 1 but for rounding and what the first step hides. Without ratios
  /// (null) polarization is what the solver assumes (particle_matrix). Throws std::invalid_argument.
  PhaseFunction(std::shared_ptr<const PhaseAngles> angles, std::vector<double> logarithms,
                std::shared_ptr<const PolarizationRatios> polarization = nullptr);

  double at(double cosine) const;
  /// What stands at the corner of a rectangle about the forward direction, of sides `width` and `height` (radians,
  /// small), so that the function has its own mean over it where it is linear along both sides between the corners;
  /// never less than at the next corner.
  double forward_for(double width, double height) const;
  /// Mean over the sphere of the function times Legendre's polynomial l < PhaseAngles::kMoments: the asymmetry is moment 1.
  double moment(int l) const { return moments_[static_cast<std::size_t>(l)]; }

  /// The scattering matrix at an angle and at one of the nodes; `peak_polarization` is of particle_matrix.
  ScatteringMatrix matrix(double cosine, double peak_polarization) const;
  ScatteringMatrix matrix_at_node(std::size_t node, double peak_polarization) const;

  const PhaseAngles& angles() const { return *angles_; }
  const std::vector<double>& at_nodes() const { return at_nodes_; }
  const std::vector<double>& logarithms() const { return logarithms_; }  ///< normalized
  double peak_exponent() const { return peak_exponent_; }
  const PolarizationRatios* polarization() const { return polarization_.get(); }  ///< null: assumed
  /// Mean over the sphere of what was given, before it was scaled: 1 where the first step can make it so.
  double given_mean() const { return given_mean_; }

 private:
  void set_slopes();
  void set_moments();
  double peak_mean(double exponent) const;
  double fitted_exponent(double mean) const;
  double logarithm(std::size_t step, double position) const;
  struct Place {
    std::size_t step;
    double position;
  };
  Place place(double cosine) const;
  ScatteringMatrix matrix(const Place& at, double cosine, double a1, double peak_polarization) const;

  std::shared_ptr<const PhaseAngles> angles_;
  std::vector<double> logarithms_, slope_;  ///< slope: per radian
  double peak_exponent_ = 2.0, given_mean_ = 1.0;
  std::vector<double> at_nodes_, moments_;
  std::shared_ptr<const PolarizationRatios> polarization_;
};

/// Phase functions of the aerosol of a column's layers at one wavelength.
struct AerosolPhases {
  std::vector<PhaseFunction> functions;
  /// [layer, from the ground up][function]: of what a layer's aerosol scatters; 1 in all where it does.
  std::vector<double> share;
  const double* shares(std::size_t layer) const { return share.data() + layer * functions.size(); }
  double moment(std::size_t layer, int l) const;
};

}  // namespace ifov::atmosphere
