#pragma once

#include <cmath>
#include <numbers>

namespace ifov::radiometry {

/// Light of any state of polarization, in any unit of radiance or irradiance, about the axes x and y of a
/// PolarizationFrame, with x, y and the direction of propagation k right-handed (x cross y = k). The one place
/// where signs are settled (docs/theory/polarization.md):
///
/// The field is the real part of (E_x x + E_y y) exp(i (k r - omega t)), and with means over time
///   I = |E_x|^2 + |E_y|^2,      Q = |E_x|^2 - |E_y|^2,
///   U = 2 Re(E_x conj(E_y)),    V = -2 Im(E_x conj(E_y)).
/// Q > 0: light swings along x. U > 0: along the middle between x and y, which is 45 degrees counterclockwise
/// from x for one whom the light meets. V > 0: at a fixed place the field turns from x to y, counterclockwise
/// for one whom the light meets and clockwise for one who looks along it: right-handed as IEEE and the
/// International Astronomical Union have it (Hamaker and Bregman 1996, A&AS 117, 161; with x north and y east
/// these are the IAU's parameters of 1974). The index of refraction of what absorbs is n + ik, k > 0.
///
/// Other signs of U and V, frame by frame, are those of a y that points the other way.
struct StokesVector {
  double i = 0.0, q = 0.0, u = 0.0, v = 0.0;

  StokesVector& operator+=(const StokesVector& other) {
    i += other.i;
    q += other.q;
    u += other.u;
    v += other.v;
    return *this;
  }
  friend StokesVector operator+(StokesVector a, const StokesVector& b) { return a += b; }
  friend StokesVector operator*(double factor, const StokesVector& s) {
    return {factor * s.i, factor * s.q, factor * s.u, factor * s.v};
  }
};

/// sqrt(Q^2 + U^2) / I; 0 of darkness, as the other degrees.
inline double degree_of_linear_polarization(const StokesVector& s) {
  return s.i > 0.0 ? std::hypot(s.q, s.u) / s.i : 0.0;
}

/// |V| / I.
inline double degree_of_circular_polarization(const StokesVector& s) {
  return s.i > 0.0 ? std::abs(s.v) / s.i : 0.0;
}

/// sqrt(Q^2 + U^2 + V^2) / I: at most 1 of light that can be.
inline double degree_of_polarization(const StokesVector& s) {
  return s.i > 0.0 ? std::hypot(s.q, s.u, s.v) / s.i : 0.0;
}

/// Angle from x towards y of the line along which light swings most, 0 to pi; 0 where there is none.
inline double angle_of_linear_polarization_rad(const StokesVector& s) {
  const double angle = 0.5 * std::atan2(s.u, s.q);
  return angle < 0.0 ? angle + std::numbers::pi : angle;
}

}  // namespace ifov::radiometry
