#include "atmosphere/scattering/scattering_matrix.h"

#include <algorithm>
#include <cmath>

#include "math/vec3.h"

namespace ifov::atmosphere {

namespace {

using math::Vec3;

struct Basis {
  Vec3 k, theta, phi;
};

Basis basis_of(const Propagation& direction) {
  const double mu = direction.mu, sine = std::sqrt(std::max(0.0, 1.0 - mu * mu));
  const double c = std::cos(direction.azimuth_rad), s = std::sin(direction.azimuth_rad);
  return {{sine * c, sine * s, mu}, {mu * c, mu * s, -sine}, {-s, c, 0.0}};
}

/// cos and sin of twice the angle by which a ray's meridian basis is turned into its scattering-plane basis.
struct Turn {
  double cos2 = 1.0, sin2 = 0.0;
};

Turn turn_of(const Basis& ray, const Vec3& normal) {
  const Vec3 parallel = cross(normal, ray.k);
  const double c = dot(parallel, ray.theta), s = dot(parallel, ray.phi);
  return {c * c - s * s, 2.0 * c * s};
}

Vec3 plane_normal(const Basis& in, const Basis& out) {
  const Vec3 normal = cross(in.k, out.k);
  const double sine = length(normal);
  // Forward and backward there is no plane, and any serves.
  if (sine < 1e-12) return out.phi;
  return normal / sine;
}

}  // namespace

ScatteringMatrix rayleigh_matrix(double cosine, double depolarization) {
  const double dipole = (1.0 - depolarization) / (1.0 + 0.5 * depolarization), square = cosine * cosine;
  return {0.75 * dipole * (1.0 + square) + (1.0 - dipole), 0.75 * dipole * (1.0 + square),
          1.5 * dipole * cosine, -0.75 * dipole * (1.0 - square)};
}

ScatteringMatrix aerosol_matrix(double cosine, double asymmetry, double peak_polarization) {
  const double g = asymmetry, base = 1.0 + g * g - 2.0 * g * cosine;
  const double a1 = (1.0 - g * g) / (base * std::sqrt(base)), shape = 1.0 / (1.0 + cosine * cosine);
  return {a1, a1, 2.0 * cosine * shape * a1, -peak_polarization * (1.0 - cosine * cosine) * shape * a1};
}

double scattering_cosine(const Propagation& from, const Propagation& to) {
  const double sines = std::sqrt(std::max(0.0, (1.0 - from.mu * from.mu) * (1.0 - to.mu * to.mu)));
  return std::clamp(from.mu * to.mu + sines * std::cos(to.azimuth_rad - from.azimuth_rad), -1.0, 1.0);
}

std::array<double, 9> meridian_matrix(const Propagation& from, const Propagation& to,
                                      const ScatteringMatrix& matrix) {
  const Basis in = basis_of(from), out = basis_of(to);
  const Vec3 normal = plane_normal(in, out);
  const Turn first = turn_of(in, normal), second = turn_of(out, normal);
  // Columns: unit I, Q and U in the incoming meridian basis.
  std::array<double, 9> result{};
  for (int column = 0; column < 3; ++column) {
    const double i = column == 0, q = column == 1, u = column == 2;
    const double q1 = q * first.cos2 + u * first.sin2, u1 = -q * first.sin2 + u * first.cos2;
    const double i2 = matrix.a1 * i + matrix.b1 * q1, q2 = matrix.b1 * i + matrix.a2 * q1,
                 u2 = matrix.a3 * u1;
    result[column] = i2;
    result[3 + column] = q2 * second.cos2 - u2 * second.sin2;
    result[6 + column] = q2 * second.sin2 + u2 * second.cos2;
  }
  return result;
}

Stokes scatter_unpolarized(const Propagation& from, const Propagation& to, const ScatteringMatrix& matrix) {
  const Basis in = basis_of(from), out = basis_of(to);
  const Turn turn = turn_of(out, plane_normal(in, out));
  return {matrix.a1, matrix.b1 * turn.cos2, matrix.b1 * turn.sin2};
}

}  // namespace ifov::atmosphere
