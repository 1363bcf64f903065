#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace ifov::atmosphere {

class ScatteringColumn;

/// How much brighter light of the ground is about a round Earth than in flat layers, once it was scattered: the
/// mean radiance over all directions, of a simpler problem that is solved in both. Such light depends on altitude alone. Scattering is
/// even in all directions, of aerosol as much as does not go on (1 - g). Ratios are what counts
/// (docs/theory/atmosphere_round_earth.md): what altitudes and directions are too few for is the same in both.
class ShellMeans {
 public:
  explicit ShellMeans(const ScatteringColumn& column);

  /// At the column's boundaries of sublayers, top down: the ratio of light that has been scattered. `unscattered`: means of what is
  /// scattered first, there.
  std::vector<double> ratio_of_scattered(std::span<const double> unscattered) const;

 private:
  enum Geometry : std::size_t { kRound, kFlat };
  using Kernel = std::vector<std::vector<double>>;  ///< [altitude][source's altitude]
  Kernel kernel(Geometry geometry) const;
  /// Of the sources at altitudes, in what arrives along a ray.
  std::vector<double> weights(std::size_t at, double mu, Geometry geometry) const;
  static std::vector<double> arriving(const std::vector<double>& source, const Kernel& kernel);
  std::vector<double> at_altitudes(std::span<const double> values) const;
  /// At the column's boundaries.
  std::vector<double> ratio(const std::vector<double>& round, const std::vector<double>& flat) const;

  std::vector<double> boundary_km_;             ///< of the column
  std::vector<double> altitude_km_;             ///< falling
  std::vector<double> extinction_km_, albedo_;  ///< between altitudes
  std::array<Kernel, 2> kernel_;                ///< of what is scattered, by geometry
};

}  // namespace ifov::atmosphere
