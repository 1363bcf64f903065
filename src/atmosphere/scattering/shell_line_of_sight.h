#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "atmosphere/scattering/phase/propagation.h"

namespace ifov::atmosphere {

/// A straight line of sight through the layers of a column, from the observer backwards along the light, with the way that sunlight
/// takes to its places. About a round Earth the vertical turns along it, and with it the height of the Sun; the scattering angle
/// is the same all along. All of this is geometry: one line serves every wavelength. Not refracted.
class ShellLineOfSight {
 public:
  struct Ends {
    double lower_km = 0.0;  ///< where the light's zenith angle and the Sun's are those that were given
    double upper_km = 0.0;
  };
  /// Boundaries of layers from the top down, km; the lowest is the ground, which casts the Earth's shadow. `sun_mu`: cosine of the Sun's
  /// zenith angle over the lower end, negative below the horizon. The observer stands at the upper end where light goes up (mu >
  /// 0), at the lower one where it comes down. Flat layers where not `spherical`: then the Sun is up. `sunbeams`: whether
  /// beam_depths() is wanted; then layers are cut where the Sun is low, and at the Earth's shadow.
  ShellLineOfSight(std::span<const double> altitude_km, bool spherical, double sun_mu,
                   const Propagation& direction, const Ends& ends, bool sunbeams = true);

  struct Piece {
    std::size_t layer = 0;                           ///< from the top down
    double near_position = 0.0, far_position = 0.0;  ///< from 0 at the layer's top to 1 at its bottom
    double slant = 0.0;                              ///< length over the layer's thickness
    bool lit = true;                                 ///< not in the Earth's shadow
  };
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// At the ends of pieces, pieces().size() + 1: cosines of the Sun's zenith angle there, and of the angle between the direction that the
  /// light comes from and the vertical there.
  const std::vector<double>& sun_mu() const { return sun_mu_; }
  const std::vector<double>& from_mu() const { return from_mu_; }
  const Propagation& direction() const { return direction_; }
  /// Whether the beam's depth is far from linear along pieces: the Sun is low about a round Earth.
  bool bends() const;
  double scattering_cosine() const { return scattering_cosine_; }

  /// Optical depths of the sunbeam that arrives at the ends of pieces, from depths of the layers (vertical, from the top down). Where
  /// the Earth is in the way: as if it ended just below the beam.
  std::vector<double> beam_depths(std::span<const double> depth) const;
  /// The same within a piece, at a share of its length from its near end.
  double beam_depth_within(std::size_t piece, double share, std::span<const double> depth) const;

 private:
  /// Of the beam that arrives at this radius under this cosine, in each layer, length over thickness: told to add(layer, slant).
  template <class Add>
  void beam_slants(double radius, double mu, const Add& add) const;
  void add_beams(std::span<const double> place_km), add_beams_from_above(std::span<const double> place_km);

  bool spherical_;
  std::vector<double> altitude_km_;  ///< of the layers' boundaries
  double start_ = 0.0, rise_ = 0.0;  ///< at the lower end: radius, cosine between the line and the vertical
  double sun_at_start_ = 1.0, towards_ = 1.0;  ///< of the Sun there; between it and the line from there up
  std::vector<double> length_;                 ///< of the ends of pieces from the lower end
  Propagation direction_;
  double scattering_cosine_ = 1.0;
  std::vector<Piece> pieces_;
  std::vector<double> sun_mu_, from_mu_, sun_slant_;  ///< the last: [layer][place], of the sunbeam
  /// By layer, the places whose sunbeam may cross it, where the Sun is up: those that are not above it.
  struct Range {
    std::size_t first = 0, last = 0;
  };
  std::vector<Range> crossing_;  ///< empty: all
};

}  // namespace ifov::atmosphere
