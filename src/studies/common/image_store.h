#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "render/tile_sink.h"

namespace ifov::studies {

/// A finished image in memory, with what it cost.
class ImageStore final : public render::TileSink {
 public:
  void begin(const render::ImageInfo& info) override;
  void write(const sampling::TileResult& tile) override;

  int width() const { return width_; }
  int height() const { return height_; }
  int columns() const { return columns_; }
  std::size_t index(int x_px, int y_px) const { return static_cast<std::size_t>(y_px * width_ + x_px); }

  /// Row by row, columns of a pixel side by side.
  const std::vector<float>& mean() const { return mean_; }
  /// NaN where the sampling says nothing of its error.
  const std::vector<float>& half_width() const { return half_width_; }
  const std::vector<std::uint32_t>& samples() const { return samples_; }
  /// Whether the pixel is as sure as was asked.
  bool converged(std::size_t pixel) const { return converged_[pixel] != 0; }
  /// Materials found in a pixel, by material index; their `pixel` is the index in the image.
  std::span<const sampling::Abundance> abundances(std::size_t pixel) const { return abundances_[pixel]; }

  /// Points queried, by purpose, and rays, by kind.
  struct Cost {
    std::uint64_t samples = 0;                                   ///< all points, the halo's included
    std::uint64_t halo = 0, pilot = 0, probe = 0, radiance = 0;  ///< of which
    sampling::RayCounts rays;
    Cost& operator+=(const Cost& other);
  };
  const Cost& cost() const { return cost_; }

  /// Of the RMS error over the image, by channel, as the sampling tells it; empty where it tells none.
  std::vector<double> stated_rms() const;

 private:
  std::mutex mutex_;
  int width_ = 0, height_ = 0, columns_ = 0;
  std::vector<float> mean_, half_width_;
  std::vector<std::uint32_t> samples_;
  std::vector<std::uint8_t> converged_;
  std::vector<std::vector<sampling::Abundance>> abundances_;
  Cost cost_;
  std::vector<double> stated_squares_;  // by channel, summed over pixels
};

}  // namespace ifov::studies
