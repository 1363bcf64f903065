#pragma once

#include <cstdint>
#include <vector>

#include "sampling/accuracy/edge_tracer.h"
#include "sampling/accuracy/small_vector.h"
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
  SmallVector<int, 1> outputs;           ///< row-major indices in the tile
  SmallVector<std::uint32_t, 2> labels;  ///< one region per label
  SmallVector<double, 2> area;           ///< of each region, px^2
  SmallVector<double, 2> weight;         ///< [output][region]: integral of the footprint over the region
  SmallVector<Border, 1> borders;        ///< pairs of labels that share traced borders
  /// [output][pair]: variance of the weight that lies on the wrong side
  SmallVector<double, 1> border_variance;
  SmallVector<Loose, 1> loose;  ///< cells counted by their corners, those of the same two labels together
  SmallVector<double, 1> loose_weight;  ///< [output][cell]

  std::uint32_t region_of(std::uint32_t label) const;
};

/// Integrates the leaves of the traced model against the footprint. No rays.
class LeafIntegrator {
 public:
  LeafIntegrator(const EdgeTracer& tracer, const PixelFootprint& footprint, PixelRect tile);

  /// The model of the source pixel with this index in the tracer's domain.
  void pixel(int source, PixelModel& model) const;

  /// Whether the pixel weighs in one output alone and no border crosses it: `label` then has the weight
  /// `weight`.
  bool plain(int source, int& output, std::uint32_t& label, double& weight) const;

  /// Integral of an output pixel's footprint over the whole source pixel.
  double whole_weight(int source, int output) const;

  /// Image position of the footprint's centre for an output pixel.
  Point2 centre(int output) const;

  bool unit_box() const { return unit_box_; }
  const PixelFootprint& footprint() const { return footprint_; }

 private:
  void outputs_of(int source, SmallVector<int, 1>& outputs) const;
  void leaves_of(int source) const;
  double over_polygon(const Polygon& polygon, Point2 centre) const;

  const EdgeTracer& tracer_;
  const PixelFootprint& footprint_;
  PixelRect tile_;
  bool unit_box_;
  double plain_weight_ = 0.0;
  mutable std::vector<std::uint32_t> leaves_;  // of the pixel at hand
};

}  // namespace ifov::sampling
