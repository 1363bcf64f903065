#pragma once

#include <span>
#include <vector>

#include "atmosphere/scattering/scattered_field.h"
#include "atmosphere/scattering/sun_cell.h"

namespace ifov::atmosphere {

/// Radiance I of scattered light that comes down from the directions of one zenith angle (mu <= 0), by
/// azimuth: what SlantSource::sky() tells of each, in one walk for all of them.
/// Exactly towards the Sun it has the value that gives the cells around, linear between their directions, all the light
/// that phase functions with a narrow peak scatter into them (PhaseFunction::forward_for).
std::vector<double> sky_ring(const ScatteredField& field, double mu, std::span<const double> azimuth_rad,
                             double observer_km, const SunCell& cell = {});

/// The same with its polarization; i is what sky_ring() tells, bit for bit.
std::vector<StokesVector> sky_ring_stokes(const ScatteredField& field, double mu,
                                          std::span<const double> azimuth_rad, double observer_km,
                                          const SunCell& cell = {});

}  // namespace ifov::atmosphere
