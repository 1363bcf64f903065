#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ifov::materials {

/// A measured BRDF or BTDF on a grid of directions and wavelengths: isotropic, by the zenith angles of light and view and the azimuth
/// between them, or not, by two zenith angles and two azimuths. Of a BTDF the zenith angle of the view is from the normal on its own side,
/// and azimuths are those of the directions towards light and view along the surface, so that what goes straight on has 180 deg between them.
struct MeasuredBrdf {
  /// Rise strictly; zeniths within [0, pi/2); azimuths between them from 0 (the viewer has the light in the back) to pi.
  std::vector<double> zenith_in_rad, zenith_out_rad, azimuth_rad, wavelength_um;
  /// Of one that is not isotropic, whose azimuth_rad is empty: within [0, 2 pi), from the direction of the table, counterclockwise as
  /// seen from the side of the light.
  std::vector<double> azimuth_in_rad = {}, azimuth_out_rad = {};
  /// 1/sr; the wavelength changes fastest, then the azimuth between them or of the view, the zenith of the view, the azimuth of the light,
  /// the zenith of the light.
  std::vector<double> brdf = {};

  bool is_isotropic() const { return azimuth_in_rad.empty(); }
  /// `azimuth`: between them, or of the view; that of the light, `turn`, is 0 of an isotropic table.
  double at(std::size_t in, std::size_t turn, std::size_t out, std::size_t azimuth,
            std::size_t wavelength) const {
    const std::size_t turns = is_isotropic() ? 1 : azimuth_in_rad.size(),
                      azimuths = is_isotropic() ? azimuth_rad.size() : azimuth_out_rad.size();
    return brdf[(((in * turns + turn) * zenith_out_rad.size() + out) * azimuths + azimuth) *
                    wavelength_um.size() +
                wavelength];
  }
};

/// The same, reciprocal and passive: one set of directions for light and view, those of both; linear between angles, and
/// the outermost zenith angle's values go on beyond. A sheet is taken to be the same from both sides: what it lets through of light from
/// direction a towards b it lets through from b towards a.
class BsdfTable {
 public:
  enum class Kind : std::uint8_t { reflected, transmitted };
  /// What is allowed before a table is refused or repaired.
  static constexpr double kMostAsymmetry =
      0.01;  ///< of the mean of both directions and 1 % of the largest value
  static constexpr double kMostReflectance = 1.0 + 1e-3;

  static constexpr std::size_t kMostRows = 60'000;  ///< pairs of directions, each a spectrum at every node

  /// Both directions' mean is taken everywhere. Where they differ by more than kMostAsymmetry, or where more leaves than
  /// arrives, throws InputError with the worst pair of angles, or the wavelength, the angle and by how much; unless `repair`:
  /// then the mean stands, a wavelength of which too much leaves is scaled down, and changes() tells. InputError also where azimuths that
  /// go round leave out more than 90 deg.
  BsdfTable(const MeasuredBrdf& measured, bool repair, Kind kind = Kind::reflected);

  /// The same of a sheet: no more is reflected and let through together than arrives. InputError where the tables have other wavelengths,
  /// and as above; what is repaired `reflected` tells.
  static void limit_sum(BsdfTable& reflected, BsdfTable& transmitted, bool repair);

  const std::vector<std::string>& changes() const { return changes_; }
  const std::vector<double>& wavelength_um() const { return wavelength_um_; }
  bool is_isotropic() const { return turn_rad_.empty(); }

  /// Of a pair of directions and an azimuth between them, by wavelength. A direction is a zenith angle, or of a table that is not
  /// isotropic zenith angle x azimuths + azimuth; then the azimuth between them is 0.
  const double* brdf(std::size_t a, std::size_t b, std::size_t azimuth) const {
    return &brdf_[row(a, b, azimuth) * wavelength_um_.size()];
  }
  std::size_t row_count() const {
    return direction_count() * (direction_count() + 1) / 2 * azimuth_rad_.size();
  }
  std::size_t row(std::size_t a, std::size_t b, std::size_t azimuth) const {
    const std::size_t high = a > b ? a : b, low = a > b ? b : a;
    return (high * (high + 1) / 2 + low) * azimuth_rad_.size() + azimuth;
  }

  /// Solid angle of its narrowest peak that holds a part of the light worth telling, projected: what exceeds twice the mean over its largest
  /// value. 2 pi: it has none.
  double narrowest_peak_sr() const;

  /// A direction on its side: azimuths of a table that is not isotropic are counterclockwise as seen from that side.
  struct Direction {
    double zenith_rad = 0.0, azimuth_rad = 0.0;
  };
  /// Rows between which a pair of directions lies, and their weights, which sum to 1.
  struct Corners {
    std::array<std::size_t, 16> row;
    std::array<double, 16> weight;
    std::size_t count = 0;
  };
  /// `between_rad`, 0 to pi, is asked of isotropic tables alone.
  Corners corners(Direction in, Direction out, double between_rad) const;

 private:
  struct Share {
    std::size_t direction;
    double weight;
  };
  std::array<Share, 4> shares(Direction direction) const;
  std::size_t direction_count() const { return zenith_rad_.size() * (is_isotropic() ? 1 : turn_rad_.size()); }
  Direction direction(std::size_t index) const;
  std::string named(Direction direction) const;
  void make_reciprocal(const MeasuredBrdf& measured, bool repair);
  void make_passive(bool repair);
  /// Of light from all sides towards a direction of the table.
  std::vector<double> directional_hemispherical(std::size_t direction) const;
  std::vector<std::vector<double>> all_hemispherical() const;
  void scale(std::size_t wavelength, double factor);

  Kind kind_;
  std::vector<double> zenith_rad_, azimuth_rad_, turn_rad_, wavelength_um_, brdf_;
  std::vector<std::string> changes_;
};

/// Where an angle lies among those of a table: between `below` and the next, by `share`; at an end beyond them.
struct Bracket {
  std::size_t below = 0;
  double share = 0.0;
};
Bracket bracket(const std::vector<double>& rising, double value);

}  // namespace ifov::materials
