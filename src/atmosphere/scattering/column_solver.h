#pragma once

#include <memory>
#include <vector>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/layer_optics.h"
#include "atmosphere/scattering/phase/phase_expansion.h"
#include "atmosphere/scattering/scattered_field.h"
#include "atmosphere/scattering/scattering_options.h"

namespace ifov::atmosphere {

class DirectionalGround;
class GroundModes;
struct ReflectedLight;

/// Everything that one wavelength and one absorption term of a column give the renderer. The ground is black
/// in `sunlit` and adds through the coupling terms of 6S (Vermote et al. 1997): with Lambertian ground of albedo a   E = E_black / (1 - a S),
///   L = L_black + T L_surface + t a E / pi,   t = diffuse_transmittance.
/// Radiances and irradiances are for sunlight of irradiance 1 across the beam above the air.
class ColumnSolution {
 public:
  ColumnSolution(ScatteredField sunlit, ScatteredField groundlit,
                 std::shared_ptr<const ReflectedLight> reflected = nullptr)
      : sunlit_(std::move(sunlit)), groundlit_(std::move(groundlit)), reflected_(std::move(reflected)) {}

  /// Light of the Sun over black ground: path radiance, sky, fluxes.
  const ScatteredField& sunlit() const { return sunlit_; }
  /// Light of a ground of radiance 1 in all directions, scattered at least once: sky above bright ground, and
  /// what reaches a sensor from beside the point that it looks at.
  const ScatteredField& groundlit() const { return groundlit_; }

  /// Albedo of the air for isotropic light from below (S).
  double spherical_albedo() const;
  /// Radiance of scattered light that an observer above receives from ground of radiance 1 everywhere, in
  /// light that propagates with mu > 0. Light straight from the ground is not in it.
  /// `surface_km`: where the line of sight begins, and has this zenith angle; not below the ground.
  StokesVector diffuse_transmittance(double mu, double observer_km, double surface_km = -kEndless_km) const;
  /// Of all light that leaves level ground alike in every direction, what goes up through a level, straight and scattered, and
  /// what comes down through it again.
  struct GroundFlux {
    double up = 1.0, down = 0.0;
  };
  GroundFlux ground_flux(double altitude_km) const;
  /// Null where the ground is Lambertian, or reflects nothing.
  const ReflectedLight* reflected() const { return reflected_.get(); }
  /// The same as spherical_albedo(), diffuse_transmittance() and ground_flux(), of light that leaves the ground as reflected()
  /// does, with an exitance of pi. There has to be some.
  double reflected_albedo() const;
  StokesVector reflected_transmittance(const Propagation& direction, double observer_km,
                                       double surface_km = -kEndless_km) const;
  GroundFlux reflected_flux(double altitude_km) const;
  /// Transmittance of the sunbeam down to an altitude.
  double sun_transmittance(double altitude_km) const;

 private:
  std::vector<double> depths_below(double altitude_km, const std::vector<double>& mu) const;
  ScatteredField sunlit_, groundlit_;
  std::shared_ptr<const ReflectedLight> reflected_;
};

/// What comes straight through a vertical optical depth of the light that goes up alike in every direction, 2 E_3(depth).
double straight_flux(double depth);

/// Solves columns. Constant after construction: one solver serves any number of threads.
class ColumnSolver {
 public:
  /// Throws std::invalid_argument where an option makes no sense.
  explicit ColumnSolver(const ScatteringOptions& options = {});
  const ScatteringOptions& options() const { return options_; }

  /// Of the zenith angle, in each hemisphere.
  const GaussNodes& nodes() const { return nodes_; }
  /// A ground's modes as solutions for this Sun take them.
  GroundModes modes_of(const DirectionalGround& ground, double wavelength_um, double sun_zenith_rad) const;

  /// Throws std::invalid_argument as ScatteringColumn does. `ground`: of modes_of(), for this Sun; null: no reflected().
  ColumnSolution solve(const Levels& levels, const LayerOptics& optics, double sun_zenith_rad,
                       const GroundModes* ground = nullptr) const;
  /// The same with light scattered once only: what MultipleScatteringTable completes. Several times faster.
  ColumnSolution solve_first_order(const Levels& levels, const LayerOptics& optics,
                                   double sun_zenith_rad) const;

 private:
  ColumnSolution solve(const Levels& levels, const LayerOptics& optics, double sun_zenith_rad,
                       const ScatteringOptions& options, const GroundModes* ground) const;
  ScatteringOptions options_;
  GaussNodes nodes_;
  AerosolProjection aerosol_;
};

}  // namespace ifov::atmosphere
