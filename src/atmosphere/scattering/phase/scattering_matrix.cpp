#include "atmosphere/scattering/phase/scattering_matrix.h"

#include <algorithm>
#include <cmath>

namespace ifov::atmosphere {

ScatteringMatrix rayleigh_matrix(double cosine, double depolarization) {
  const double dipole = (1.0 - depolarization) / (1.0 + 0.5 * depolarization), square = cosine * cosine;
  return {0.75 * dipole * (1.0 + square) + (1.0 - dipole), 0.75 * dipole * (1.0 + square),
          1.5 * dipole * cosine, -0.75 * dipole * (1.0 - square)};
}

ScatteringMatrix particle_matrix(double cosine, double a1, double peak_polarization) {
  const double shape = 1.0 / (1.0 + cosine * cosine);
  return {a1, a1, 2.0 * cosine * shape * a1, -peak_polarization * (1.0 - cosine * cosine) * shape * a1};
}

ScatteringMatrix aerosol_matrix(double cosine, double asymmetry, double peak_polarization) {
  const double g = asymmetry, base = 1.0 + g * g - 2.0 * g * cosine;
  return particle_matrix(cosine, (1.0 - g * g) / (base * std::sqrt(base)), peak_polarization);
}

double scattering_cosine(const Propagation& from, const Propagation& to) {
  const double sines = std::sqrt(std::max(0.0, (1.0 - from.mu * from.mu) * (1.0 - to.mu * to.mu)));
  return std::clamp(from.mu * to.mu + sines * std::cos(to.azimuth_rad - from.azimuth_rad), -1.0, 1.0);
}

std::array<double, 9> meridian_matrix(const Propagation& from, const Propagation& to,
                                      const ScatteringMatrix& matrix) {
  const radiometry::PolarizationFrame in = from.frame(), out = to.frame();
  const radiometry::MuellerMatrix in_plane({matrix.a1, matrix.b1, 0, 0,  //
                                            matrix.b1, matrix.a2, 0, 0,  //
                                            0, 0, matrix.a3, 0,          //
                                            0, 0, 0, 0});
  const radiometry::MuellerMatrix all =
      about(in_plane, radiometry::scattering_frames(in.direction, out.direction), in, out);
  std::array<double, 9> result;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) result[3 * row + column] = all(row, column);
  return result;
}

StokesVector scatter_unpolarized(const Propagation& from, const Propagation& to,
                                 const ScatteringMatrix& matrix) {
  const radiometry::PolarizationFrame out = to.frame(), own = radiometry::scattering_frames(
                                                                  from.frame().direction, out.direction)
                                                                  .after;
  return turned(own, out) * StokesVector{matrix.a1, matrix.b1, 0.0, 0.0};
}

}  // namespace ifov::atmosphere
