#pragma once

#include "atmosphere/scattering/phase/propagation.h"
#include "atmosphere/scattering/scattering_column.h"
#include "atmosphere/scattering/slant_path.h"
#include "atmosphere/scattering/sun_cell.h"

namespace ifov::atmosphere {

class ShellLineOfSight;

/// Light that a path adds, and what it lets through.
struct PathLight {
  StokesVector single;    ///< scattered once, with the whole phase function
  StokesVector multiple;  ///< scattered more often
  double transmittance = 1.0;
  /// exp(-scaled depth): what is let through where light scattered into the forward peak counts as not
  /// scattered.
  double peak_transmittance = 1.0;
  StokesVector radiance() const { return single + multiple; }
};

/// Sunlight of irradiance 1 (across the beam, above the air) scattered once into `direction`, on the way to
/// an observer; and the transmittance of that way. Exact for homogeneous layers: depths are delta-M scaled
/// and the phase function is whole (TMS, Nakajima and Tanaka 1988). `multiple` stays 0.
/// A column for this alone needs no sublayers (most_sublayers = 1): pieces of a layer add up to it.
PathLight single_scattering(const ScatteringColumn& column, double aerosol_polarization,
                            const Propagation& direction, double observer_km, double length_km = kEndless_km);
/// The same along a line through the layers of this column (column.layer_altitude_km), with the height that the Sun has over
/// each place of it: exact in homogeneous layers but for how the sunbeam's depth bends within them.
/// Exactly towards the Sun phase functions have their value for the cell, if there is one (PhaseFunction::forward_for).
PathLight single_scattering(const ScatteringColumn& column, double aerosol_polarization,
                            const ShellLineOfSight& line, const SunCell& cell = {});

}  // namespace ifov::atmosphere
