#pragma once

namespace ifov::atmosphere {

/// Linear polarization of a ray: Stokes parameters I, Q and U (circular polarization of the sky is below 1e-3
/// of the linear one and is left out).
///
/// Convention. Light propagates along k(theta, phi) with theta counted from the zenith, so that cos theta > 0
/// is light going up. The basis is l = e_theta (in the meridian plane) and r = e_phi, with l x r = k:
///   I = |E_l|^2 + |E_r|^2,  Q = |E_l|^2 - |E_r|^2,  U = 2 Re(E_l conj(E_r)).
/// In a basis turned by eta (l' = cos eta l + sin eta r) Q' = Q cos 2 eta + U sin 2 eta and
/// U' = -Q sin 2 eta + U cos 2 eta. The tables of Coulson and of Natraj, Li and Yung (2009) have the opposite
/// sign of Q and the same sign of U.
struct Stokes {
  double i = 0.0, q = 0.0, u = 0.0;

  Stokes& operator+=(const Stokes& other) {
    i += other.i;
    q += other.q;
    u += other.u;
    return *this;
  }
  friend Stokes operator+(Stokes a, const Stokes& b) { return a += b; }
  friend Stokes operator*(double factor, const Stokes& s) {
    return {factor * s.i, factor * s.q, factor * s.u};
  }
};

/// Direction in which light propagates.
struct Propagation {
  double mu = 1.0;           ///< cosine of the angle from the zenith: > 0 going up, < 0 coming down
  double azimuth_rad = 0.0;  ///< from the azimuth in which sunlight propagates: 0 is forward scattering
};

}  // namespace ifov::atmosphere
