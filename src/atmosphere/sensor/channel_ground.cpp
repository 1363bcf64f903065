// The part of ChannelScattering that tells what the air does to light of a directional ground.
#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "atmosphere/scattering/ground/ground_modes.h"
#include "atmosphere/scattering/reflected_light.h"
#include "atmosphere/scattering/sky_ring.h"
#include "atmosphere/sensor/channel_scattering.h"
#include "atmosphere/sensor/directions/sky_directions.h"

namespace ifov::atmosphere {

/// By wavelength of the solutions.
struct ChannelScattering::Modes {
  explicit Modes(std::size_t wavelengths) : of(wavelengths), once(wavelengths) {}
  std::vector<std::shared_ptr<const GroundModes>> of;
  std::vector<std::once_flag> once;
};

void ChannelScattering::make_room_for_modes() {
  if (ground_ != nullptr) modes_ = std::make_shared<Modes>(log_wavelength_.size());
}

std::size_t ChannelScattering::reflected_count() const {
  if (ground_ == nullptr) return 0;
  return reflected_head() + 3 * directions_.zenith_rad.size() * directions_.azimuth_rad.size();
}

std::shared_ptr<const GroundModes> ChannelScattering::ground_modes(const ColumnSolver& solver,
                                                                   std::size_t wavelength) const {
  if (ground_ == nullptr || !sunlit_) return nullptr;
  std::call_once(modes_->once[wavelength], [&] {
    modes_->of[wavelength] = std::make_shared<const GroundModes>(
        solver.modes_of(*ground_, std::exp(log_wavelength_[wavelength]), geometry_.any_sun_zenith_rad()));
  });
  return modes_->of[wavelength];
}

/// Where nothing is reflected of sunlight, as Lambertian ground.
void ChannelScattering::solve_reflected(const ColumnSolution& solved, Node& node) const {
  const double ground_km = column_.levels().altitude_km.front();
  const bool any = solved.reflected() != nullptr;
  const auto ratio = [](double value, double whole) { return whole > 0.0 ? value / whole : 1.0; };
  std::vector<double>& to = node.reflected;
  to = {any ? ratio(solved.reflected_albedo(), solved.spherical_albedo()) : 1.0, 1.0, 1.0};
  if (any && geometry_.level_fluxes) {
    const ColumnSolution::GroundFlux given = solved.reflected_flux(geometry_.sensor_altitude_km),
                                     even = solved.ground_flux(geometry_.sensor_altitude_km);
    to[1] = ratio(given.up, even.up), to[2] = ratio(given.down, even.down);
  }
  for (const LineOfSight& line : lines()) {
    const double mu = std::cos(line.zenith_rad), surface_km = ground_km + line.height_km;
    const StokesVector even = solved.diffuse_transmittance(mu, line.sensor_km, surface_km);
    const StokesVector given = any ? solved.reflected_transmittance({mu, line.azimuth_rad - std::numbers::pi},
                                                                    line.sensor_km, surface_km)
                                   : even;
    to.insert(to.end(), {ratio(given.i, even.i), given.i > 0.0 ? given.q / given.i : 0.0,
                         given.i > 0.0 ? given.u / given.i : 0.0});
  }
  const ScatteredField& field = any ? solved.reflected()->field : solved.groundlit();
  const std::size_t zeniths = directions_.zenith_rad.size(), azimuths = directions_.azimuth_rad.size();
  const std::size_t start = to.size(), count = zeniths * azimuths;
  to.resize(start + 3 * count, 0.0);
  const std::vector<double> weights = directions_.level_weights();
  double sum = 0.0;
  for (std::size_t z = 0; z < zeniths; ++z) {
    const std::vector<StokesVector> ring =
        sky_ring_stokes(field, -std::cos(directions_.zenith_rad[z]), directions_.azimuth_rad, ground_km);
    for (std::size_t a = 0; a < azimuths; ++a) {
      const std::size_t d = z * azimuths + a;
      to[start + d] = std::max(0.0, ring[a].i);
      to[start + count + d] = ring[a].q, to[start + 2 * count + d] = ring[a].u;
      sum += weights[d] * to[start + d];
    }
  }
  for (std::size_t k = start; k < to.size() && sum > 0.0; ++k) to[k] *= std::numbers::pi / sum;
}

void ChannelScattering::add_reflected(std::size_t point, const std::vector<Part>& parts, AtPoints& at) const {
  const auto mean = [&](std::size_t k) {
    double sum = 0.0;
    for (const Part& part : parts) sum += part.plain * part.node->reflected[k];
    return sum;
  };
  at.reflected_albedo.push_back(at.spherical_albedo[point] * mean(0));
  if (geometry_.level_fluxes) {
    at.reflected_up.push_back(at.ground_up[point] * mean(1));
    at.reflected_down.push_back(at.ground_down[point] * mean(2));
  }
  for (std::size_t line = 0; line < at.reflected_i.size(); ++line) {
    const double even =
        line == 0 ? at.diffuse_transmittance[point] : at.line_of_sight_diffuse[line - 1][point];
    const double all = even * mean(3 + 3 * line);
    at.reflected_i[line][point] = all;
    at.reflected_q[line][point] = all * mean(4 + 3 * line);
    at.reflected_u[line][point] = all * mean(5 + 3 * line);
  }
}

}  // namespace ifov::atmosphere
