#include "atmosphere/scattering/sky_ring.h"

namespace ifov::atmosphere {

std::vector<double> sky_ring(const ScatteredField& field, double mu, std::span<const double> azimuth_rad,
                             double observer_km, const SunCell& cell) {
  std::vector<double> radiance;
  for (const StokesVector& light : sky_ring_stokes(field, mu, azimuth_rad, observer_km, cell))
    radiance.push_back(light.i);
  return radiance;
}

std::vector<StokesVector> sky_ring_stokes(const ScatteredField& field, double mu,
                                          std::span<const double> azimuth_rad, double observer_km,
                                          const SunCell& cell) {
  const SlantSource source = field.along(mu);
  std::vector<StokesVector> light;
  for (const double azimuth : azimuth_rad) light.push_back(source.sky(azimuth, observer_km, cell).radiance());
  return light;
}

}  // namespace ifov::atmosphere
