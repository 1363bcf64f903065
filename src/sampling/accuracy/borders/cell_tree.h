#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/accuracy/basis/flat_map.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/no_label.h"
#include "sampling/accuracy/borders/cell.h"

namespace ifov::sampling {

class PointQueries;
class TracedPixels;

/// The quadtree of cells over a tile's lattice, and the labels of their vertices. It knows cells and vertices, not what
/// borders run between them. Cells are numbered in the order of their making, those of the lattice row by row.
class CellTree {
 public:
  CellTree(const Lattice& lattice, PointQueries& queries, TracedPixels& pixels)
      : lattice_(lattice), queries_(queries), pixels_(pixels) {}

  /// Makes the cells of the lattice from the labels of its vertices, row by row.
  void plant(std::span<const std::uint32_t> vertex_labels);

  const Lattice& lattice() const { return lattice_; }
  Cell& operator[](std::uint32_t cell) { return cells_[cell]; }
  const Cell& operator[](std::uint32_t cell) const { return cells_[cell]; }

  /// The leaf that holds a point; points on the rim go inside.
  std::uint32_t leaf_at(FocalPoint point) const;

  /// Gives the cell four children, unless it has them or is as small as cells get. References to cells end.
  void split(std::uint32_t cell);

  /// Cells that have no kind yet.
  const std::vector<std::uint32_t>& fresh_cells() const { return fresh_cells_; }
  /// One batch of rays at the vertices of fresh cells. Where what they find in the middle of a side has neither end's
  /// label, the neighbour is split as well: false, and there is more to ask.
  bool look_at_vertices();
  /// Hands the fresh cells over.
  void take_fresh(std::vector<std::uint32_t>& cells) {
    cells.clear();
    cells.swap(fresh_cells_);
  }

  /// Labels of a cell's corners, going round. They have to be known.
  void corner_labels(const Cell& cell, std::uint32_t corner[4]) const;
  /// The label of a position; kNoLabel where it is not known, or lies outside.
  std::uint32_t label_if_known(std::int32_t x, std::int32_t y) const;

 private:
  /// A position beside a side whose middle differs from its two ends: cells there must be smaller than
  /// `level`.
  struct HangingNode {
    std::int32_t x, y;
    int level;
  };

  void add_cell(std::int32_t x, std::int32_t y, int level);
  std::uint32_t find_leaf(std::int32_t x, std::int32_t y) const;
  void want_vertex(std::int32_t x, std::int32_t y);
  void trace_vertices();
  void notice_hanging_nodes();
  void split_beside_hanging_nodes();
  std::uint32_t known_label(std::int32_t x, std::int32_t y) const {
    return Lattice::on_lattice(x, y) ? root_labels_[lattice_.vertex_number(x, y)]
                                     : fine_labels_[vertex_index_.find(Lattice::vertex_key(x, y))];
  }

  const Lattice& lattice_;
  PointQueries& queries_;
  TracedPixels& pixels_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> root_labels_;  // of the lattice's own vertices
  FlatMap vertex_index_;                    // of the others
  std::vector<std::uint32_t> fine_labels_;  // of the others, in order of discovery
  std::vector<FocalPoint> pending_;         // of these, those not traced yet: the last
  std::vector<std::uint32_t> fresh_cells_, split_cells_;
  std::vector<HangingNode> hanging_;
};

}  // namespace ifov::sampling
