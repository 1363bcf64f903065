#pragma once

#include <vector>

namespace ifov::atmosphere {

/// Wigner's d-functions d^l_mn(x), x = cos theta, for l = 0 .. count - 1 (0 below max(|m|, |n|)), by the
/// recurrence in l of Mishchenko, Travis and Lacis (2002), appendix B.
std::vector<double> wigner_d(int m, int n, int count, double x);

/// The functions that expand one azimuthal mode of the phase matrix in Stokes (I, Q, U), at one direction
/// cosine:
///   p = d^l_m0,  r = (d^l_m2 + d^l_m,-2) / 2,  t = (d^l_m,-2 - d^l_m2) / 2,   l = mode .. count - 1.
/// They are P, R and T of Siewert (2000), with the sign of t that this project's U needs.
struct SphericalFunctions {
  std::vector<double> p, r, t;
};

SphericalFunctions spherical_functions(int mode, int count, double mu);

}  // namespace ifov::atmosphere
