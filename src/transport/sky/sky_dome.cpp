#include "transport/sky/sky_dome.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "atmosphere/sensor/directions/kept_integrals.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "radiometry/polarization_frame.h"
#include "transport/sky/ground_around.h"
#include "transport/sky/sky_refinement.h"

namespace ifov::transport {
namespace {

/// Index of the interval that holds x, and the share of its upper end.
std::pair<std::size_t, double> bracket(const std::vector<double>& nodes, double x) {
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
  const std::size_t low = static_cast<std::size_t>(above - nodes.begin()) - 1;
  return {low, std::clamp((x - nodes[low]) / (nodes[low + 1] - nodes[low]), 0.0, 1.0)};
}

/// What level ground takes of it, by node.
std::vector<double> level_irradiance(const SkyGrid& grid, const radiometry::SpectrumBlock& spectra) {
  const std::vector<double> weights =
      atmosphere::SkyDirections{grid.zenith_rad, grid.azimuth_rad}.level_weights();
  std::vector<double> sum(spectra.columns(), 0.0);
  for (std::size_t r = 0; r < spectra.rows(); ++r)
    for (std::size_t n = 0; n < sum.size(); ++n)
      sum[n] += weights[r] * static_cast<double>(spectra.row(r)[n]);
  return sum;
}

}  // namespace

SkyDome::SkyDome(const atmosphere::SensorAtmosphere& atmosphere, math::Vec3 towards_sun,
                 const GroundAround& ground, bool polarized)
    : towards_sun_(towards_sun),
      zenith_rad_(atmosphere.sky_directions().zenith_rad),
      azimuth_rad_(atmosphere.sky_directions().azimuth_rad),
      spectra_(zenith_rad_.size() * azimuth_rad_.size(), atmosphere.node_count()) {
  for (std::size_t z = 0; z < zenith_rad_.size(); ++z)
    for (std::size_t a = 0; a < azimuth_rad_.size(); ++a)
      for (std::size_t n = 0; n < atmosphere.node_count(); ++n)
        spectra_.row(z * azimuth_rad_.size() + a)[n] = static_cast<float>(ground.sky(atmosphere, z, a, n));
  if (polarized && atmosphere.polarized())
    refine(atmosphere, ground);
  else
    keep_integrals();
  make_sampler(atmosphere.node_count());
  irradiance_ =
      std::make_unique<const SkyIrradiance>(SkyTable{zenith_rad_, azimuth_rad_, spectra_, towards_sun_});
}

/// What is linear between the table's directions is off by 5e-4 of the Sun's irradiance over pi in a clear sky: too much for degrees
/// of polarization.
void SkyDome::refine(const atmosphere::SensorAtmosphere& atmosphere, const GroundAround& ground) {
  radiometry::SpectrumBlock q(spectra_.rows(), atmosphere.node_count()),
      u(spectra_.rows(), atmosphere.node_count());
  for (std::size_t r = 0; r < spectra_.rows(); ++r) {
    const std::size_t z = r / azimuth_rad_.size(), a = r % azimuth_rad_.size();
    for (std::size_t n = 0; n < atmosphere.node_count(); ++n) {
      const radiometry::StokesVector light = ground.sky_stokes(atmosphere, z, a, n);
      q.row(r)[n] = static_cast<float>(light.q);
      u.row(r)[n] = static_cast<float>(light.u);
    }
  }
  const SkyGrid grid{zenith_rad_, azimuth_rad_};
  SkyGrid finer = refined(grid);
  const std::vector<double> taken = level_irradiance(grid, spectra_);
  spectra_ = refined(grid, spectra_, 1.0f);
  q_ = refined(grid, q, 1.0f);
  u_ = refined(grid, u, -1.0f);
  zenith_rad_ = std::move(finer.zenith_rad), azimuth_rad_ = std::move(finer.azimuth_rad);
  scale_to(taken);
}

/// The tables are as bright as gives level ground this irradiance, linear between directions.
void SkyDome::scale_to(const std::vector<double>& level) {
  const std::vector<double> now = level_irradiance({zenith_rad_, azimuth_rad_}, spectra_);
  for (radiometry::SpectrumBlock* block : {&spectra_, &q_, &u_})
    for (std::size_t r = 0; r < block->rows(); ++r)
      for (std::size_t n = 0; n < level.size(); ++n)
        if (now[n] > 0.0) block->row(r)[n] *= static_cast<float>(level[n] / now[n]);
}

/// Level ground takes what it took.
void SkyDome::keep_integrals() {
  const SkyGrid grid{zenith_rad_, azimuth_rad_};
  const std::vector<double> taken = level_irradiance(grid, spectra_);
  std::vector<double> sky(spectra_.rows());
  for (std::size_t n = 0; n < taken.size(); ++n) {
    for (std::size_t r = 0; r < sky.size(); ++r) sky[r] = static_cast<double>(spectra_.row(r)[n]);
    atmosphere::keep_integrals({zenith_rad_, azimuth_rad_}, sky);
    for (std::size_t r = 0; r < sky.size(); ++r) spectra_.row(r)[n] = static_cast<float>(sky[r]);
  }
  scale_to(taken);
}

/// A cell between directions of the table is as bright as the mean of its corners; nodes count by their share of their
/// own sky's irradiance.
void SkyDome::make_sampler(std::size_t nodes) {
  const std::size_t rings = zenith_rad_.size() - 1, azimuths = azimuth_rad_.size() - 1;
  const auto corners = [&](std::size_t z, std::size_t a, std::size_t n) {
    return 0.25 *
           (spectrum(z, a)[n] + spectrum(z, a + 1)[n] + spectrum(z + 1, a)[n] + spectrum(z + 1, a + 1)[n]);
  };
  std::vector<double> brightness(rings * azimuths, 0.0);
  for (std::size_t n = 0; n < nodes; ++n) {
    double all = 0.0;
    for (std::size_t z = 0; z < rings; ++z)
      for (std::size_t a = 0; a < azimuths; ++a)
        all += corners(z, a, n) *
               (std::pow(std::sin(zenith_rad_[z + 1]), 2) - std::pow(std::sin(zenith_rad_[z]), 2));
    if (!(all > 0.0)) continue;
    for (std::size_t z = 0; z < rings; ++z)
      for (std::size_t a = 0; a < azimuths; ++a) brightness[z * azimuths + a] += corners(z, a, n) / all;
  }
  if (std::any_of(brightness.begin(), brightness.end(), [](double b) { return b > 0.0; }))
    sampler_ = SkySampler(zenith_rad_, azimuth_rad_, towards_sun_, brightness);
}

SkyIrradiance::Corners SkyDome::irradiance(math::Vec3 normal) const {
  return irradiance_->at(normal, {zenith_rad_, azimuth_rad_, spectra_, towards_sun_});
}

SkyDome::Corners SkyDome::at(math::Vec3 direction) const {
  const double zenith = std::acos(std::clamp(direction.z, 0.0, 1.0));
  const double along = direction.x * towards_sun_.x + direction.y * towards_sun_.y;
  const double across = direction.x * towards_sun_.y - direction.y * towards_sun_.x;
  const double azimuth = std::atan2(std::abs(across), along);
  const auto [z, above] = bracket(zenith_rad_, zenith);
  const auto [a, beyond] = bracket(azimuth_rad_, azimuth);
  return {{spectrum(z, a), spectrum(z, a + 1), spectrum(z + 1, a), spectrum(z + 1, a + 1)},
          {static_cast<float>((1.0 - above) * (1.0 - beyond)), static_cast<float>((1.0 - above) * beyond),
           static_cast<float>(above * (1.0 - beyond)), static_cast<float>(above * beyond)}};
}

SkyDome::PolarizedCorners SkyDome::polarization(const Corners& corners, math::Vec3 direction,
                                                const radiometry::PolarizationFrame& frame) const {
  // Towards the direction's own azimuth from the Sun's, counterclockwise on one side and clockwise on the other.
  const double along = direction.x * towards_sun_.x + direction.y * towards_sun_.y;
  const double left = direction.y * towards_sun_.x - direction.x * towards_sun_.y;
  const double side = left < 0.0 ? -1.0 : 1.0, from_sun = std::atan2(std::abs(left), along);
  const bool vertical = !(std::hypot(direction.x, direction.y) > 0.0);
  const double own =
      vertical ? std::atan2(towards_sun_.y, towards_sun_.x) : std::atan2(direction.y, direction.x);
  PolarizedCorners result;
  result.side = static_cast<float>(side);
  for (std::size_t k = 0; k < corners.spectrum.size(); ++k) {
    const std::size_t r = static_cast<std::size_t>(corners.spectrum[k] - spectra_.row(0)) / spectra_.stride();
    result.q[k] = q_.row(r);
    result.u[k] = u_.row(r);
    const double weight = static_cast<double>(corners.weight[k]);
    if (weight == 0.0) continue;
    const double zenith = zenith_rad_[r / azimuth_rad_.size()],
                 azimuth = azimuth_rad_[r % azimuth_rad_.size()];
    const radiometry::PolarizationFrame there =
        radiometry::meridional_frame(-std::cos(zenith), own + side * (azimuth - from_sun) + std::numbers::pi);
    const radiometry::MuellerMatrix turn = turned(radiometry::carried(there, frame.direction), frame);
    result.cosine[k] = static_cast<float>(weight * turn(1, 1));
    result.sine[k] = static_cast<float>(weight * turn(1, 2));
  }
  return result;
}

radiometry::PolarizationFrame SkyDome::stokes(math::Vec3 direction,
                                              std::span<radiometry::StokesVector> nodes) const {
  const Corners corners = at(direction);
  const radiometry::PolarizationFrame frame = radiometry::meridional_frame(-direction);
  const PolarizedCorners sky = polarization(corners, direction, frame);
  std::fill(nodes.begin(), nodes.end(), radiometry::StokesVector{});
  for (std::size_t k = 0; k < corners.spectrum.size(); ++k) {
    const double weight = static_cast<double>(corners.weight[k]), c = static_cast<double>(sky.cosine[k]),
                 s = static_cast<double>(sky.sine[k]);
    if (weight == 0.0) continue;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const double q = static_cast<double>(sky.q[k][n]), u = static_cast<double>(sky.side * sky.u[k][n]);
      nodes[n] += radiometry::StokesVector{weight * static_cast<double>(corners.spectrum[k][n]),
                                           c * q + s * u, c * u - s * q, 0.0};
    }
  }
  return frame;
}

}  // namespace ifov::transport
