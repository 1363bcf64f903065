#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace ifov::atmosphere {

class SensorAtmosphere;

/// Radiance at the sensor to reflectance of level, uniform Lambertian ground, channel by channel, by the tables of its air
/// (docs/theory/atmosphere_inversion.md, equation 1; Vermote et al., IEEE TGRS 35 (1997) 675, equation 2, node by node).
class ReflectanceRetrieval {
 public:
  explicit ReflectanceRetrieval(const SensorAtmosphere& air);

  /// Whether the channel sees reflected sunlight and, next to it, no emission of the ground.
  bool possible(std::size_t channel) const { return possible_[channel] != 0; }
  const std::vector<std::size_t>& left_out() const { return left_out_; }

  /// W m-2 sr-1 um-1 over ground of a reflectance below 1 / S, and of black ground.
  double radiance(std::size_t channel, double reflectance) const;
  double path(std::size_t channel) const { return radiance(channel, 0.0); }
  /// Below 0 where the radiance is below the path's.
  double reflectance(std::size_t channel, double radiance) const;
  /// How far it may be off where the radiance is off by as much: the wider side.
  double half_width(std::size_t channel, double radiance, double radiance_half_width) const;

 private:
  struct Node {
    double path, lit, albedo;  // L = path + lit rho / (1 - albedo rho), weighted
  };
  std::span<const Node> nodes(std::size_t channel) const;
  double slope(std::size_t channel, double reflectance) const;
  std::vector<Node> nodes_;
  std::vector<std::size_t> first_;
  std::vector<char> possible_;
  std::vector<std::size_t> left_out_;
};

}  // namespace ifov::atmosphere
