#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sampling/field.h"

namespace ifov::sampling {
class ColumnFootprints;
class Tolerance;
struct TileResult;
}  // namespace ifov::sampling

namespace ifov::render {

/// Light on the focal plane from images that are smaller than a pixel, as points of it: each stands for an area of the
/// plane with one radiance, in one of several replicates of the whole, whose spread tells the error.
class FocalLights {
 public:
  static constexpr std::uint32_t kReplicates = 8;
  struct Light {
    sampling::FocalPoint at;
    float per_radiance = 0.0f;  ///< px2; times its spectrum
    std::uint32_t spectrum = 0;
    std::uint32_t replicate = 0;
  };

  explicit FocalLights(std::size_t channels) : channels_(channels) {}

  /// Radiance by channel; returns its number.
  std::uint32_t add_spectrum(std::span<const float> channels);
  void add(const Light& light) { lights_.push_back(light); }
  void append(const FocalLights& other);
  /// Keeps the first ones that were added.
  void keep(std::size_t count) { lights_.resize(count); }
  /// Before add_to.
  void sort();

  /// Into the means of a tile that has channels alone, with the error of their shares in each pixel; `tolerance` may be
  /// null. `kept`: by group of footprints, the share of a response that its footprint holds, where the rest is in wings; empty: all.
  void add_to(const sampling::ColumnFootprints& footprints, const sampling::Tolerance* tolerance,
              sampling::TileResult& tile, std::span<const double> kept = {}) const;

  /// All of them, as wings see them: what lies in one cell of a grid is one. By place.
  struct Distant {
    sampling::FocalPoint middle;
    std::vector<float> light,
        variance;  ///< by channel: integral over the focal plane; of its mean over replicates
  };
  std::vector<Distant> distant() const;
  /// Side of the cells, px, and how many may be: larger ones are taken where there are more.
  static constexpr double kDistantCell_px = 0.5;
  static constexpr std::size_t kMostDistant = std::size_t{1} << 14;

  std::span<const Light> lights() const { return lights_; }

 private:
  std::size_t channels_;
  std::vector<Light> lights_;   // by row of the image
  std::vector<float> spectra_;  // [spectrum][channel]
};

}  // namespace ifov::render
