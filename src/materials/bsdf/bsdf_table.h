#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ifov::materials {

/// A measured isotropic BRDF on a grid: zenith angles of light and view, the azimuth between them, wavelength.
struct MeasuredBrdf {
  /// Rise strictly; zeniths within [0, pi/2), azimuths from 0 (the viewer has the light in the back) to pi.
  std::vector<double> zenith_in_rad, zenith_out_rad, azimuth_rad, wavelength_um;
  /// 1/sr; the wavelength changes fastest, then azimuth, view, light.
  std::vector<double> brdf;

  double at(std::size_t in, std::size_t out, std::size_t azimuth, std::size_t wavelength) const {
    return brdf[((in * zenith_out_rad.size() + out) * azimuth_rad.size() + azimuth) * wavelength_um.size() +
                wavelength];
  }
};

/// The same, reciprocal and passive: one set of zenith angles for light and view, those of both; linear between angles, and
/// the outermost values go on beyond.
class BsdfTable {
 public:
  /// What is allowed before a table is refused or repaired.
  static constexpr double kMostAsymmetry =
      0.01;  ///< of the mean of both directions and 1 % of the largest value
  static constexpr double kMostReflectance = 1.0 + 1e-3;

  static constexpr std::size_t kMostRows = 20'000;  ///< pairs of directions, each a spectrum at every node

  /// Both directions' mean is taken everywhere. Where they differ by more than kMostAsymmetry, or where more comes back than
  /// arrives, throws InputError with the worst pair of angles, or the wavelength, the angle and by how much; unless `repair`:
  /// then the mean stands, a wavelength that sends back too much is scaled down, and changes() tells.
  BsdfTable(const MeasuredBrdf& measured, bool repair);

  const std::vector<std::string>& changes() const { return changes_; }
  const std::vector<double>& zenith_rad() const { return zenith_rad_; }
  const std::vector<double>& azimuth_rad() const { return azimuth_rad_; }
  const std::vector<double>& wavelength_um() const { return wavelength_um_; }
  /// Of a pair of zenith angles in either order and an azimuth, by wavelength.
  const double* brdf(std::size_t a, std::size_t b, std::size_t azimuth) const {
    return &brdf_[row(a, b, azimuth) * wavelength_um_.size()];
  }
  std::size_t row_count() const {
    return zenith_rad_.size() * (zenith_rad_.size() + 1) / 2 * azimuth_rad_.size();
  }
  std::size_t row(std::size_t a, std::size_t b, std::size_t azimuth) const {
    const std::size_t high = a > b ? a : b, low = a > b ? b : a;
    return (high * (high + 1) / 2 + low) * azimuth_rad_.size() + azimuth;
  }

 private:
  void make_reciprocal(const MeasuredBrdf& measured, bool repair);
  void make_passive(bool repair);
  /// Of light from all sides towards a zenith angle of the table.
  std::vector<double> directional_hemispherical(std::size_t zenith) const;

  std::vector<double> zenith_rad_, azimuth_rad_, wavelength_um_, brdf_;
  std::vector<std::string> changes_;
};

/// Where an angle lies among those of a table: between `below` and the next, by `share`; at an end beyond them.
struct Bracket {
  std::size_t below = 0;
  double share = 0.0;
};
Bracket bracket(const std::vector<double>& rising, double value);

}  // namespace ifov::materials
