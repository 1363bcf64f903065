#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/accuracy/borders/bracket_store.h"
#include "sampling/accuracy/borders/cell_tree.h"
#include "sampling/accuracy/borders/curve.h"
#include "sampling/accuracy/borders/junction.h"

namespace ifov::sampling {

/// The borders that run through cells, curves and junctions, and what follows from where they run: regions, their areas,
/// the variances of these, and the label of any point. It asks nothing and decides nothing.
class BorderModel {
 public:
  BorderModel(const CellTree& tree, const BracketStore& brackets) : tree_(tree), brackets_(brackets) {}

  const CellTree& tree() const { return tree_; }
  const BracketStore& brackets() const { return brackets_; }
  void reserve(std::size_t curves) { curves_.reserve(curves); }

  /// The number that the cell then has in Cell::chord.
  std::uint32_t add(const Curve& curve);
  std::uint32_t add(const Junction& junction);
  Curve& curve_of(const Cell& cell) { return curves_[cell.chord]; }
  const Curve& curve_of(const Cell& cell) const { return curves_[cell.chord]; }
  Junction& junction_of(const Cell& cell) { return junctions_[cell.chord]; }
  const Junction& junction_of(const Cell& cell) const { return junctions_[cell.chord]; }

  /// Where a curve is drawn from and to.
  CurveEnds drawn_ends(const Curve& curve) const {
    return {brackets_.end_point(curve.bracket[0]), brackets_.end_point(curve.bracket[1])};
  }
  /// Where middles are predicted from.
  CurveEnds ends(const Curve& curve) const {
    return {brackets_.middle_point(curve.bracket[0]), brackets_.middle_point(curve.bracket[1])};
  }
  /// Mean width of the brackets at its ends.
  double blur(const Curve& curve) const {
    return 0.5 * (brackets_[curve.bracket[0]].width() + brackets_[curve.bracket[1]].width());
  }
  /// Where the border that leaves cell `from` through a bracket ends in the cell beyond; false where none goes on.
  bool neighbour_end(std::uint32_t bracket, std::uint32_t from, Point2& point) const;

  CurveShape shape_of(const Cell& cell) const;
  /// The region of `inner` in a cell with a curve, as a polygon in image coordinates.
  Polygon inner_region(const Cell& cell, const CurveShape& shape) const;
  /// What it leaves of the cell; it goes round the same way.
  Polygon outer_region(const Cell& cell, const CurveShape& shape) const;
  /// Length swept by the border per unit of motion of each end along its side.
  void sweep(const Cell& cell, const CurveShape& shape, double swept[2]) const;
  /// The same as far as it is known: where both ends lie at a corner of the cell, for all that their brackets tell, the border may be as
  /// long as these.
  void sweep_at_most(const Cell& cell, const CurveShape& shape, double swept[2]) const;
  /// Area that `inner` gains, px^2, where the middles of the brackets of its ends lie beyond the sides (Bracket::excess).
  double area_beyond(const Cell& cell, const CurveShape& shape) const;
  /// Variance of the area of `inner` in px^4, from crossings, middle and legs; Curve::loose_area comes on
  /// top.
  double area_variance(const Cell& cell, const CurveShape& shape) const;

  void crossings(const Junction& junction, Point2 crossing[3]) const;
  /// Sector i of a cell with a junction, as a polygon in image coordinates.
  Polygon sector_region(const Cell& cell, int sector) const;
  /// Variance of the area that the sectors on either side of a junction's border i may have exchanged, px^4.
  double border_variance(const Cell& cell, int border) const;

  /// The label at a point of the cell; kNoLabel in complex cells.
  std::uint32_t label_in(const Cell& cell, FocalPoint point) const;
  std::uint32_t label_at(FocalPoint point) const { return label_in(tree_[tree_.leaf_at(point)], point); }

 private:
  /// With the corners from `first` to `last`, round the cell.
  Polygon region_beside(const Cell& cell, const CurveShape& shape, int first, int last, bool outer) const;

  const CellTree& tree_;
  const BracketStore& brackets_;
  std::vector<Curve> curves_;
  std::vector<Junction> junctions_;
};

}  // namespace ifov::sampling
