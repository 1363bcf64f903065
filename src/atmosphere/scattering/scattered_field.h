#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "atmosphere/scattering/column_phase.h"
#include "atmosphere/scattering/mode_moments.h"
#include "atmosphere/scattering/single_scattering.h"

namespace ifov::atmosphere {

class RoundEarthLight;

/// Irradiances on horizontal surfaces against altitude (boundaries of sublayers, from the top down).
struct FluxProfile {
  std::vector<double> altitude_km, direct_down, diffuse_down, up;
  struct Fluxes {
    double direct_down = 0.0, diffuse_down = 0.0, up = 0.0;
  };
  /// Linear between boundaries, constant beyond the ends.
  Fluxes at(double altitude_km) const;
};

/// A column that has been solved and can be scattered in once more: the source function of scattered light at
/// every altitude and in every direction, from which the light of any path follows. Constant; any number of
/// threads.
struct SolvedColumn {
  ScatteringColumn column;
  ColumnPhase phase;
  double aerosol_polarization = 0.0;
  std::shared_ptr<const RoundEarthLight> round_earth = {};  ///< null: none
  /// Sunlight's moments over columns of RoundEarthLight::brighter_suns_rad(), [brighter][mode].
  std::vector<std::vector<ModeMoments>> brighter = {};
};

class ScatteredField;

/// The source of scattered light in directions of one zenith angle, by altitude and azimuthal mode. Made once
/// for a ring of directions; paths of any azimuth, altitude and length are integrated in it.
class SlantSource {
 public:
  SlantSource(const ScatteredField& field, double mu);
  double mu() const { return mu_; }
  /// Light of a path in flat layers that ends at an observer at this altitude and is `length_km` long.
  PathLight path(double azimuth_rad, double observer_km, double length_km = kEndless_km) const;
  /// Light that goes up (mu > 0) from a place, where it has this zenith angle and the Sun its own, to a sensor; and light that
  /// comes down from space (mu <= 0) to an observer, right down to the horizon. Both through shells about a round Earth, where
  /// the column has them, with the height that the Sun has over each place of the line.
  PathLight line_of_sight(double azimuth_rad, double sensor_km, double surface_km) const;
  PathLight sky(double azimuth_rad, double observer_km, const SunCell& cell = {}) const;

 private:
  class Sum;
  PathLight through_shells(double azimuth_rad, double lower_km, double upper_km, const SunCell& cell) const;
  const ScatteredField* field_;
  double mu_;
  std::vector<double> source_;  ///< [mode][component][top, bottom][sublayer]
  /// The same over columns of brighter places, as much as is there of the own light.
  std::vector<std::vector<double>> brighter_;
};

/// Light scattered by a column over black ground, from one kind of illumination.
class ScatteredField {
 public:
  ScatteredField(std::shared_ptr<const SolvedColumn> solved, std::vector<ModeMoments> modes,
                 FluxProfile fluxes, bool sunlit, int orders)
      : solved_(std::move(solved)),
        modes_(std::move(modes)),
        fluxes_(std::move(fluxes)),
        sunlit_(sunlit),
        orders_(orders) {}

  /// Valid as long as the field is.
  SlantSource along(double mu) const { return SlantSource(*this, mu); }
  /// The same for a single direction.
  PathLight path(const Propagation& direction, double observer_km, double length_km = kEndless_km) const {
    return along(direction.mu).path(direction.azimuth_rad, observer_km, length_km);
  }
  PathLight line_of_sight(const Propagation& direction, double sensor_km, double surface_km) const {
    return along(direction.mu).line_of_sight(direction.azimuth_rad, sensor_km, surface_km);
  }
  PathLight sky(const Propagation& direction, double observer_km) const {
    return along(direction.mu).sky(direction.azimuth_rad, observer_km);
  }
  const FluxProfile& fluxes() const { return fluxes_; }
  const SolvedColumn& solved() const { return *solved_; }
  const std::vector<ModeMoments>& modes() const { return modes_; }
  bool sunlit() const { return sunlit_; }
  int orders() const { return orders_; }  ///< of scattering, in mode 0

 private:
  std::shared_ptr<const SolvedColumn> solved_;
  std::vector<ModeMoments> modes_;
  FluxProfile fluxes_;
  bool sunlit_;
  int orders_;
};

}  // namespace ifov::atmosphere
