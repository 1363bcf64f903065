#pragma once

#include <cstdint>
#include <vector>

#include "studies/common/exact_area.h"

namespace ifov::io {
struct Document;
struct SamplingDocument;
}  // namespace ifov::io

namespace ifov::studies {

/// A mosaic of Voronoi cells, each one of six black materials between 20 and 40 degrees, seen at 8.5 um from
/// above by width x width pixels of 1 m: clutter with an edge wherever one looks.
class ClutterScene {
 public:
  ClutterScene(int width_px, double cells_per_px, std::uint64_t seed);

  int width() const { return width_; }
  io::Document document(io::SamplingDocument sampling, double psf_sigma_px, std::uint64_t seed) const;

  /// Radiance of each pixel, row by row, by exact areas.
  std::vector<double> pixel_truth() const;
  /// The same through a Gaussian PSF cut at +-4.4 sigma in x and y, convolved with a pixel's square: midpoint
  /// rule on `fine` points a pixel side. Within 4.4 sigma + half a pixel of the rim the outside counts as the
  /// nearest cell.
  std::vector<double> blurred_truth(double sigma_px, int fine) const;

 private:
  struct Cell {
    sampling::FocalPoint site;
    int material;
    Outline outline;
  };
  double radiance(int material) const;
  const Cell& nearest(double x_px, double y_px) const;

  static constexpr double kMargin_px = 4.0;  // cells go on beyond the image, for the PSF
  int width_;
  std::vector<Cell> cells_;
  int buckets_;  // buckets of 1 px, per side
  std::vector<std::vector<int>> bucket_cells_;
};

}  // namespace ifov::studies
