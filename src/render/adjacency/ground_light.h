#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "radiometry/spectrum_block.h"
#include "transport/sky/adjacent_ground.h"

namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

/// What the ground about an area sends up, seen from straight above: rasters about its middle, each with cells of twice the
/// side of the one before, until some 150 km around are covered. Values are by channel, and relative to brightness(). Rays
/// go straight down at fixed places; what they meet is lit by the Sun, if a ray to it is free, and by the share of the sky
/// that it faces, and warm. Lamps and hot things count as surfaces of 350 K at most: few rays would find them.
class GroundLight {
 public:
  /// Under an atmosphere (SpectralScene::sky_dome()).
  GroundLight(const transport::SpectralScene& scene, const transport::AdjacentGround::Area& area,
              int threads);

  std::size_t channels() const { return beyond_.columns(); }
  std::size_t cells_across() const { return across_; }
  double cell_m() const { return cell_m_; }  ///< of the finest raster
  /// Of a channel: a white level surface in the open and a black body of 300 K, W m-2 sr-1 um-1.
  double brightness(std::size_t channel) const { return brightness_[channel]; }
  /// The same in nodes.
  const std::vector<double>& node_brightness() const { return node_brightness_; }
  /// Largest less smallest value of any cell.
  double contrast(std::size_t channel) const { return contrast_[channel]; }

  /// Rows of values by channel about a place, linear between the middles of cells that are about as wide as asked for, and not
  /// of a raster finer than `finest`: radiance over that of the ground all around, and what of it is reflected skylight.
  struct Corners {
    std::array<const float*, 4> beyond{}, skylit{};
    std::array<float, 4> weight{};
    bool any = false;  ///< false: no raster reaches so far, and all values are 0
  };
  Corners at(double x_m, double y_m, double cell_m, std::size_t finest) const;

 private:
  void look_down(const transport::SpectralScene& scene, std::size_t level, std::size_t row);
  void take_means(std::size_t level);
  std::size_t index(std::size_t level, std::size_t column, std::size_t row) const {
    return (level * across_ + row) * across_ + column;
  }
  bool inner(std::size_t level, std::size_t column, std::size_t row) const;

  double x_m_ = 0.0, y_m_ = 0.0, cell_m_ = 0.0;  // middle; of the finest
  std::size_t across_ = 0, levels_ = 0;
  radiometry::SpectrumBlock beyond_, skylit_;  // [level][row][column]
  std::vector<double> brightness_, node_brightness_, contrast_;
};

}  // namespace ifov::render
