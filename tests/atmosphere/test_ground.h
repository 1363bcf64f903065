#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include "atmosphere/scattering/ground/directional_ground.h"
#include "radiometry/spectral_nodes.h"

namespace ifov::atmosphere::test {

/// Ground of a formula: its matrix by the cosines (both > 0) and azimuths in which light comes and goes.
class FormulaGround : public DirectionalGround {
 public:
  using Formula = std::function<GroundMatrix(const GroundEvent&)>;
  FormulaGround(Formula formula, bool polarizes, bool isotropic = true)
      : formula_(std::move(formula)), polarizes_(polarizes), isotropic_(isotropic) {}
  bool is_isotropic() const override { return isotropic_; }
  bool polarizes() const override { return polarizes_; }
  void reflect(double, std::span<const GroundEvent> events, std::span<GroundMatrix> brdf) const override {
    for (std::size_t k = 0; k < events.size(); ++k) brdf[k] = formula_(events[k]);
  }
  /// The same in all nodes.
  std::shared_ptr<const GroundAtNodes> at(const radiometry::SpectralNodes& nodes, bool) const override {
    return std::make_shared<const Nodes>(formula_, nodes.node_count());
  }

 private:
  class Nodes : public GroundAtNodes {
   public:
    Nodes(Formula formula, std::size_t count) : formula_(std::move(formula)), count_(count) {}
    void albedo(double mu, std::span<double> nodes) const override {
      constexpr int kSteps = 64, kAzimuths = 128;
      double sum = 0.0;
      for (int i = 0; i < kSteps; ++i)
        for (int a = 0; a < kAzimuths; ++a) {
          const double out = (i + 0.5) / kSteps, azimuth = 2.0 * std::numbers::pi * (a + 0.5) / kAzimuths;
          sum += formula_({out, -mu, azimuth, 0.0})[0][0] * out;
        }
      std::fill(nodes.begin(), nodes.end(), sum * 2.0 * std::numbers::pi / (kSteps * kAzimuths));
    }
    void add_reflected(const GroundEvent& event, std::span<const double> incoming,
                       std::span<double> light) const override {
      const GroundMatrix matrix = formula_(event);
      const std::size_t components = light.size() / count_;
      for (std::size_t row = 0; row < components; ++row)
        for (std::size_t column = 0; column < components; ++column)
          for (std::size_t n = 0; n < count_; ++n)
            light[row * count_ + n] += matrix[row][column] * incoming[column * count_ + n];
    }

   private:
    Formula formula_;
    std::size_t count_;
  };
  Formula formula_;
  bool polarizes_, isotropic_;
};

/// A scalar BRDF by mu in, mu out (both > 0) and the azimuth between the directions of propagation.
inline FormulaGround scalar_ground(std::function<double(double in, double out, double azimuth)> brdf) {
  return {[brdf = std::move(brdf)](const GroundEvent& e) {
            GroundMatrix matrix{};
            matrix[0][0] = brdf(-e.in_mu, e.out_mu, e.out_azimuth_rad - e.in_azimuth_rad);
            return matrix;
          },
          false};
}

/// Rahman, Pinty and Verstraete (1993), J. Geophys. Res. 98, 20791, equations 2 to 8, written out here once more.
inline double rpv_of_paper(double in, double out, double azimuth, double rho0, double k, double theta) {
  const double si = std::sqrt(1.0 - in * in), so = std::sqrt(1.0 - out * out);
  // Between the directions towards Sun and sensor; azimuth 0 of propagation is forward.
  const double relative = azimuth - std::numbers::pi;
  const double cos_g = in * out + si * so * std::cos(relative);
  const double ti = si / in, to = so / out;
  const double big_g = std::sqrt(std::max(0.0, ti * ti + to * to - 2.0 * ti * to * std::cos(relative)));
  const double f = (1.0 - theta * theta) / std::pow(1.0 + theta * theta + 2.0 * theta * cos_g, 1.5);
  return rho0 / std::numbers::pi * std::pow(in * out * (in + out), k - 1.0) * f *
         (1.0 + (1.0 - rho0) / (1.0 + big_g));
}

}  // namespace ifov::atmosphere::test
