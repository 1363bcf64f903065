#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "atmosphere/gauss_nodes.h"

namespace ifov::atmosphere {

/// Thermal light of one slant path: what it emits towards the observer, and what it lets through.
struct ThermalPath {
  double radiance = 0.0;
  double transmittance = 1.0;
};

/// Radiances at every level for one absorption term (Schwarzschild's equation without scattering): the unit
/// is that of the Planck radiances given.
struct ThermalRadiance {
  std::size_t nodes = 0;
  std::vector<double> up, down;            ///< [level][node], levels from the ground up
  std::vector<double> flux_up, flux_down;  ///< [level], irradiance on a horizontal surface
  double up_at(std::size_t level, std::size_t node) const { return up[level * nodes + node]; }
  double down_at(std::size_t level, std::size_t node) const { return down[level * nodes + node]; }
};

/// Lambertian ground: emits emissivity times `planck` and reflects the rest of the flux from above.
struct ThermalGround {
  double emissivity = 1.0;
  double planck = 0.0;
};

/// A column that emits and absorbs, at one wavelength and for one absorption term; what it scatters of its own light is told
/// to it (ThermalScattering), if anything is.
/// Within a layer extinction is constant and Planck's radiance linear in optical depth between the levels,
/// which keeps opaque bands right: their sky is as warm as the lowest air, not as the lowest layer's middle.
///
/// The spans are borrowed and must outlive the column; they run from the ground up. Lines of sight and skies
/// go through shells about a round Earth, all else through flat layers.
class ThermalColumn {
 public:
  /// altitude_km and planck at n + 1 levels, absorption depth (vertical) of n layers. Throws
  /// std::invalid_argument where sizes differ or altitudes do not rise.
  ThermalColumn(std::span<const double> altitude_km, std::span<const double> planck,
                std::span<const double> absorption_depth);
  /// The same with a depth of scattering (delta-M scaled) that takes from light besides, for sky() and line_of_sight(), which are
  /// then given what the layers scatter into their direction: [layer][lower end, upper end], the source function's part times
  /// the layer's extinction depth.
  ThermalColumn(std::span<const double> altitude_km, std::span<const double> planck,
                std::span<const double> absorption_depth, std::span<const double> scattering_depth);

  /// Without scattering: radiances up and down at all levels and at these cosines of the zenith angle (> 0), with fluxes by their
  /// weights (gauss_nodes(8) gives fluxes within 3e-4).
  ThermalRadiance radiances(const GaussNodes& nodes, const ThermalGround& ground) const;

  /// Radiance that comes down to an observer from all the air above, at cosine mu >= 0 of the zenith angle,
  /// through shells about a round Earth: right down to the horizon.
  double sky(double mu, double observer_km, std::span<const double> scattered = {}) const;

  /// The same of light that goes up from a place, at this cosine mu > 0 of the zenith angle there, to an observer above it.
  ThermalPath line_of_sight(double observer_km, double mu, double surface_km,
                            std::span<const double> scattered = {}) const;

  /// Without scattering, in flat layers: light of a straight path that ends at an observer, of light that propagates with cosine mu from the
  /// zenith (mu > 0: the observer looks down) and starts `length_km` before, or where the air ends. Ground is
  /// not in it.
  ThermalPath path(double observer_km, double mu,
                   double length_km = std::numeric_limits<double>::infinity()) const;

 private:
  double extinction(std::size_t layer) const {
    return scattering_.empty() ? depth_[layer] : depth_[layer] + scattering_[layer];
  }
  /// Source function within a layer, at a share of its height above its bottom.
  double source(std::size_t layer, double share, std::span<const double> scattered) const;
  std::span<const double> altitude_km_, planck_, depth_, scattering_;
};

}  // namespace ifov::atmosphere
