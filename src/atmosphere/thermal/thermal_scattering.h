#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "atmosphere/scattering/scattering_options.h"

namespace ifov::atmosphere {

struct LayerOptics;
struct Levels;

/// Whether a column scatters enough for its own light to be scattered in it: below 5e-4 of vertical optical depth light is
/// as it would be without, but for less than that share of it (molecules have 3e-4 at 2.4 um and fall off from there on).
bool scatters_own_light(const LayerOptics& optics);

/// Light that the layers of a column emit and scatter on the way out, at one wavelength and for one absorption term, by orders
/// of scattering as sunlight's (SuccessiveOrders::emitted). The source function is (1 - a) B + a/2 int P I dmu with B linear
/// between the levels. Over ground that is black and cold: what the ground sends is ColumnSolution::groundlit(). Layers are flat,
/// and light is unpolarized.
class ThermalScattering {
 public:
  /// Into how many sublayers each layer is cut, from the ground up: by what it scatters alone, since what it emits is exact in
  /// whole layers. Coarser by two than sunlight's, since no beam is cut.
  static std::vector<int> parts(const Levels& levels, const LayerOptics& optics,
                                const ScatteringOptions& options);
  /// `planck` at the levels, in any unit of radiance. Of the options: nodes, tolerance and orders.
  ThermalScattering(const Levels& levels, const LayerOptics& optics, std::span<const double> planck,
                    std::span<const int> parts, const ScatteringOptions& options);

  /// Sublayers from the ground up: boundaries [n + 1], B at them, vertical depths [n] of scattering, delta-M scaled.
  const std::vector<double>& altitude_km() const { return altitude_km_; }
  const std::vector<double>& planck() const { return planck_; }
  const std::vector<double>& scattering_depth() const { return scattering_depth_; }
  /// What is scattered into light that propagates with this cosine from the zenith (> 0: up), as ThermalColumn wants it:
  /// [sublayer][lower end, upper end].
  std::vector<double> scattered(double mu) const;

 private:
  std::vector<double> altitude_km_, planck_, scattering_depth_;
  int terms_ = 0;
  std::vector<double> moments_;  ///< [l][sublayer][lower end, upper end]
};

}  // namespace ifov::atmosphere
