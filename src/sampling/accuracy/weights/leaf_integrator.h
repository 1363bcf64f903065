#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sampling/accuracy/weights/pixel_model.h"
#include "sampling/footprint_groups.h"
#include "sampling/pixel_footprint.h"
#include "sampling/pixel_rect.h"
#include "sampling/random.h"

namespace ifov::sampling {

class BorderModel;
class CellTree;
class EdgeCells;
class EdgeTracer;
class Lattice;
struct Cell;
struct Polygon;

/// Integrates the leaves of the traced model against the footprints, each for its group of columns. No rays.
class LeafIntegrator {
 public:
  LeafIntegrator(const EdgeTracer& tracer, const ColumnFootprints& footprints, PixelRect tile);
  ~LeafIntegrator();

  /// The model of the source pixel with this index in the tracer's domain.
  void pixel(int source, PixelModel& model) const;

  /// Whether the pixel weighs in one output alone and no border crosses it: `label` then has the weight
  /// `weight`.
  bool plain(int source, int& output, std::uint32_t& label, double& weight) const;

  /// Integral of an output pixel's footprint over the whole source pixel.
  double whole_weight(int source, int output, std::size_t group) const;

  /// Image position of the footprint's centre for an output pixel.
  Point2 centre(int output, std::size_t group) const;

  bool unit_box() const { return unit_box_; }
  std::size_t group_of(std::size_t column) const { return footprints_.group_of(column); }
  const PixelFootprint& footprint(std::size_t group) const { return footprints_.footprint(group); }

 private:
  /// An output and a group of columns whose footprint reaches the pixel at hand.
  struct Slot {
    std::size_t at, group;  ///< position in the model's lists
    Point2 centre;
    int column, row;  ///< the first cell of the output's pixel
  };
  void outputs_of(int source, PixelModel& model) const;
  void leaves_of(int source) const;
  double cell_weight(const Cell& cell, const Slot& slot) const;
  void add_uniform(const Cell& cell, PixelModel& model) const;
  void add_complex(const Cell& cell, PixelModel& model) const;
  void add_junction(const Cell& cell, PixelModel& model) const;
  void add_curve(const Cell& cell, PixelModel& model) const;
  double over_polygon(const Polygon& polygon, const Slot& slot) const;
  void begin_polygon(std::size_t which) const;
  double over_shared(const Polygon& polygon, std::size_t which, const Slot& slot) const;
  double density(Point2 at, const Slot& slot) const {
    return footprint(slot.group).density(at.x - slot.centre.x, at.y - slot.centre.y);
  }

  const CellTree& tree_;
  const EdgeCells& edge_cells_;
  const BorderModel& model_;
  const Lattice& lattice_;
  const ColumnFootprints& footprints_;
  PixelRect tile_;
  bool unit_box_;
  double plain_weight_ = 0.0;
  struct Shared;
  std::unique_ptr<Shared> shared_;             // what several groups share; null for one
  mutable std::vector<std::uint32_t> leaves_;  // of the pixel at hand
  mutable std::vector<Slot> slots_;
};

}  // namespace ifov::sampling
