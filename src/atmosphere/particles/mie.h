#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "atmosphere/particles/size_distribution.h"

namespace ifov::atmosphere {

/// Light scattered by a sphere (Mie 1908; Bohren and Huffman 1983, ch. 4). Size parameter x = 2 pi radius / wavelength, index
/// of refraction m = n + ik relative to the medium (k > 0 absorbs, waves go as exp(-i omega t)).
///
/// Logarithmic derivatives of psi(mx) come from a downward recursion (Wiscombe 1980, Appl. Opt. 19, 1505), psi(x) from the
/// upward one as far as it is stable, n <= x, and from ratios beyond; x + 4 x^(1/3) + 2 terms or so, as Wiscombe found.
class MieSphere {
 public:
  static constexpr double kLargest = 50000.0;  ///< x
  /// Throws std::invalid_argument unless 0 < x <= 50000, n > 0 and k >= 0.
  MieSphere(double size_parameter, std::complex<double> index);
  /// Spheres of one index, in the time of one for each `kAtOnce` of them that are of about one size.
  static std::vector<MieSphere> of(std::span<const double> size_parameters, std::complex<double> index);
  static constexpr std::size_t kAtOnce = 4;

  /// Cross-sections over that of the sphere, pi radius^2.
  double extinction() const { return extinction_; }
  double scattering() const { return scattering_; }
  double asymmetry() const { return asymmetry_; }  ///< mean cosine of the scattering angle

  /// Amplitudes at cosines of the scattering angle, of fields across (S1) and in (S2) the scattering plane. All spans are of
  /// one length.
  void amplitudes(std::span<const double> cosine, std::span<std::complex<double>> s1,
                  std::span<std::complex<double>> s2) const;

 private:
  class Four;
  MieSphere() = default;
  std::vector<std::complex<double>> a_, b_;  ///< from n = 1
  double extinction_ = 0.0, scattering_ = 0.0, asymmetry_ = 0.0;
};

/// What spheres of many sizes make of light together.
struct MieMixture {
  double extinction = 0.0, scattering = 0.0;  ///< cross-sections, um^2, of a mean sphere
  double volume = 0.0;                        ///< um^3 of a mean sphere
  double asymmetry = 0.0;
  /// Scattering matrix at the cosines asked for, the mean of a1 over the sphere 1; a2 is a1.
  std::vector<double> a1, a3, b1;
};
/// `sizes` as they stand: who wants them resolved says so.
MieMixture mie_mixture(const SizeDistribution& sizes, double wavelength_um, std::complex<double> index,
                       std::span<const double> cosine);

}  // namespace ifov::atmosphere
