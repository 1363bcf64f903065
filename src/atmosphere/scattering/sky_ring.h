#pragma once

#include <span>
#include <vector>

#include "atmosphere/scattering/scattered_field.h"

namespace ifov::atmosphere {

/// Radiance I of scattered light that comes down from the directions of one zenith angle (mu <= 0), by
/// azimuth: what SlantSource::sky() tells of each, in one walk for all of them.
std::vector<double> sky_ring(const ScatteredField& field, double mu, std::span<const double> azimuth_rad,
                             double observer_km);

/// The same with its polarization; i is what sky_ring() tells, bit for bit.
std::vector<StokesVector> sky_ring_stokes(const ScatteredField& field, double mu,
                                          std::span<const double> azimuth_rad, double observer_km);

}  // namespace ifov::atmosphere
