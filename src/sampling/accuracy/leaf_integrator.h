#pragma once

#include <cstdint>
#include <vector>

#include "sampling/accuracy/edge_tracer.h"
#include "sampling/pixel_footprint.h"
#include "sampling/tile.h"

namespace ifov::sampling {

/// What tracing says about one source pixel (a pixel of the focal plane), and how much each part weighs in
/// the output pixels whose footprints reach it. Weights of one output follow each other.
struct PixelModel {
  struct Border {
    std::uint32_t inner, outer;
  };
  struct Loose {
    std::uint32_t corner[4];
    bool two_labels;
    std::int32_t x, y;  // of the cell, where it stands alone
  };
  std::vector<int> outputs;           ///< row-major indices in the tile
  std::vector<std::uint32_t> labels;  ///< one region per label
  std::vector<double> area;           ///< of each region, px^2
  std::vector<double> weight;         ///< [output][region]: integral of the footprint over the region
  std::vector<Border> borders;        ///< pairs of labels that share traced borders
  std::vector<double>
      border_variance;       ///< [output][pair]: variance of the weight that lies on the wrong side
  std::vector<Loose> loose;  ///< cells counted by their corners, those of the same two labels together
  std::vector<double> loose_weight;  ///< [output][cell]

  std::uint32_t region_of(std::uint32_t label) const;
};

/// Integrates the leaves of the traced model against the footprint. No rays.
class LeafIntegrator {
 public:
  LeafIntegrator(const EdgeTracer& tracer, const PixelFootprint& footprint, PixelRect tile);

  /// The model of the source pixel with this index in the tracer's domain.
  void pixel(int source, PixelModel& model) const;

  /// Integral of an output pixel's footprint over the whole source pixel.
  double whole_weight(int source, int output) const;

  /// Image position of the footprint's centre for an output pixel.
  Point2 centre(int output) const;

  bool unit_box() const { return unit_box_; }
  const PixelFootprint& footprint() const { return footprint_; }

 private:
  void outputs_of(int source, std::vector<int>& outputs) const;
  double over_polygon(const Polygon& polygon, Point2 centre) const;

  const EdgeTracer& tracer_;
  const PixelFootprint& footprint_;
  PixelRect tile_;
  bool unit_box_;
  std::vector<std::uint32_t> first_leaf_, leaves_;
};

}  // namespace ifov::sampling
