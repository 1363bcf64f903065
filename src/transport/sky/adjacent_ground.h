#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "radiometry/spectrum_block.h"

namespace ifov::transport {

/// How the ground about each place of an image differs from the ground that SpectralScene takes to be all around, as the air
/// sees it (docs/theory/atmosphere_adjacency.md): by place, in spectral nodes, linear between the places of an even grid.
class AdjacentGround {
 public:
  struct Area {
    double west_m = 0.0, south_m = 0.0, east_m = 0.0, north_m = 0.0;
  };
  /// A grid of `across` x `across` places over the area (at least 2), all of whose values are 0.
  AdjacentGround(const Area& area, std::size_t across, std::size_t nodes);

  std::size_t across() const { return across_; }
  double x_m(std::size_t column) const;
  double y_m(std::size_t row) const;
  /// Radiance of the ground whose light is scattered into the line of sight, over that of the ground all around, W m-2 sr-1
  /// um-1.
  float* radiance(std::size_t column, std::size_t row) { return radiance_.row(row * across_ + column); }
  /// How much brighter the sky is, in parts of itself, because of the ground whose light is sent back.
  float* sky(std::size_t column, std::size_t row) { return sky_.row(row * across_ + column); }

  struct Corners {
    std::array<const float*, 4> radiance{}, sky{};
    std::array<float, 4> weight{};
  };
  /// Beyond the grid its rim holds.
  Corners at(double x_m, double y_m) const;

  /// Adds radiance() of a place times what the air scatters into the line of sight of ground of radiance 1: a spectrum, or up
  /// to five with their weights (0 beyond their number).
  void add(double x_m, double y_m, const float* diffuse, float* light) const;
  void add(double x_m, double y_m, const std::array<const float*, 5>& diffuse,
           const std::array<float, 5>& weight, float* light) const;
  /// Multiplies spectra of the sky's light by how bright the sky is over a place (1 + sky).
  void brighten(double x_m, double y_m, float* light) const;

  /// How far path radiance may be off because of all this, by channel, W m-2 sr-1 um-1.
  std::vector<double> path_error;

 private:
  Area area_;
  std::size_t across_;
  radiometry::SpectrumBlock radiance_, sky_;
};

}  // namespace ifov::transport
