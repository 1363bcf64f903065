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

/// The same at many direction cosines: what does not depend on them is worked out once. Equal to rounding.
class SphericalSeries {
 public:
  /// Without `polarized`, p alone.
  SphericalSeries(int mode, int count, bool polarized);
  void at(double mu, SphericalFunctions& functions) const;

 private:
  /// d^l_mn by its recurrence d^(l+1) = (a_l x - b_l) d^l - c_l d^(l-1), from the lowest l that has it on.
  struct Recurrence {
    int first = 0;
    double lowest = 0.0, of_minus = 0.0, of_plus = 0.0;  ///< lowest (1 - x)^of_minus (1 + x)^of_plus
    std::vector<double> a, b, c;
    Recurrence(int m, int n, int count);
    void at(double x, std::vector<double>& d) const;
  };
  int mode_, count_;
  std::vector<Recurrence> of_;  // n = 0; 2 and -2
};

}  // namespace ifov::atmosphere
