#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "atmosphere/scattering/scattering_options.h"

namespace ifov::atmosphere {

class ThermalScattering;
struct LayerOptics;
struct Levels;

/// What a channel's air scatters of the light that it emits itself: solved at a few wavelengths and depths of gas, and kept as the source of scattered light over Planck's radiance there. That is smooth in both, while what a
/// line of sight makes of it is exact at every point of the channel, with the gas that the point has.
class ScatteredEmission {
 public:
  struct Question {
    double wavelength_um;
    const LayerOptics& optics;
  };
  /// Keeps references.
  ScatteredEmission(const Levels& levels, std::vector<Question> questions, const ScatteringOptions& options);
  ~ScatteredEmission();
  ScatteredEmission(ScatteredEmission&&) noexcept;

  /// 0 where the air scatters too little to count.
  std::size_t solutions() const;
  /// Different ones may be solved at the same time.
  void solve(std::size_t solution);

  /// Once everything is solved: sublayers, the same in all solutions: of how many each layer is cut into, and boundaries.
  const std::vector<int>& parts() const { return parts_; }
  std::span<const double> altitude_km() const;

  /// At a point of the channel that the solutions have these shares in.
  std::vector<double> scattering_depth(std::span<const double> share) const;
  /// Sources into directions of one cosine from the zenith (> 0: up), by solution.
  using Ring = std::vector<std::vector<double>>;
  Ring ring(double mu) const;
  /// As ThermalColumn wants it: `planck` at the boundaries.
  static void mix(const Ring& ring, std::span<const double> share, std::span<const double> planck,
                  std::vector<double>& scattered);

 private:
  const Levels& levels_;
  std::vector<Question> questions_;
  ScatteringOptions options_;
  std::vector<int> parts_;
  std::vector<std::optional<ThermalScattering>> solved_;
};

}  // namespace ifov::atmosphere
