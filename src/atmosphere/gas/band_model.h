#pragma once

#include <vector>

#include "atmosphere/profile/profile.h"

namespace ifov::atmosphere {

/// A spectral interval of one gas in which the exponents a, n, m hold.
struct Band {
  Gas gas = Gas::h2o;
  int first_cm1 = 0, last_cm1 = 0;
  double a = 0.0;                   ///< T = exp(-(10^C' W)^a)
  double n = 0.0, m = 0.0;          ///< W = amount (P/P0)^n (T0/T)^m
  std::vector<double> coefficient;  ///< 10^C' every 5 cm-1 from first_cm1 on

  bool covers(int wavenumber) const { return wavenumber >= first_cm1 && wavenumber <= last_cm1; }
  /// 10^C' at a multiple of 5 cm-1 that the band covers.
  double at(int wavenumber) const {
    return coefficient[static_cast<std::size_t>((wavenumber - first_cm1) / 5)];
  }
};

/// LOWTRAN7's line absorption (Pierluissi and Maragoudakis 1986; Kneizys et al. 1988, AFGL-TR-88-0177), read
/// once from data/atmosphere/gas_bands.txt.
class BandModel {
 public:
  static const BandModel& instance();
  const std::vector<Band>& bands() const { return bands_; }

 private:
  BandModel();
  std::vector<Band> bands_;
};

/// What the band model resolves: narrower channels see a smoothed spectrum.
inline constexpr double kBandResolutionCm1 = 20.0;

/// The multiple of 5 cm-1 that stands for a wavenumber.
int band_grid_cm1(double wavenumber_cm1);

/// k and weight of the terms of exp(-x^a) = sum of w exp(-k x); k rises.
struct AbsorptionTerms {
  std::vector<double> k, weight;
  double largest_error = 0.0;  ///< over x = 1e-7 to 1e3
};

/// For an exponent of the band model and 3, 5 or 8 terms (else std::out_of_range). exp(-x^a) is the Laplace
/// transform of a one-sided stable density, so such terms exist; they were fitted in the largest error
/// (data/atmosphere/absorption_terms.txt).
const AbsorptionTerms& absorption_terms(double a, int count);

}  // namespace ifov::atmosphere
