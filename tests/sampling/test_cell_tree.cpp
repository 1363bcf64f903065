#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/borders/bracket_store.h"
#include "sampling/accuracy/borders/cell_tree.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/point_queries.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "shape_field.h"

namespace ifov::sampling::test_cell_tree {
namespace {

/// A tree over 2 x 2 pixels of two cells a side, planted with the labels that a field has at the vertices.
class Planted {
 public:
  explicit Planted(test::ShapeField::LabelAt label_at)
      : field_(std::move(label_at),
               [](Label label, double, double, int) { return static_cast<float>(label); }) {
    std::vector<std::uint32_t> labels;
    std::vector<FocalPoint> points;
    for (int j = 0; j <= lattice_.rows(); ++j)
      for (int i = 0; i <= lattice_.columns(); ++i)
        points.push_back(lattice_.point(i * Lattice::side(0), j * Lattice::side(0)));
    queries_.ask(points, labels, Purpose::trace);
    asked_ = field_.counts().primary;
    contrast_.begin(4);
    for (int p = 0; p < 4; ++p) contrast_.allowed(p)[0] = 1e-3;
    tree.plant(labels);
    brackets.plant(16);
  }

  /// Rays since it was planted.
  std::uint64_t rays() const { return field_.counts().primary - asked_; }
  std::uint32_t number(double x_px, double y_px) const { return tree.leaf_at({x_px, y_px}); }

 private:
  const std::vector<int> kSteering{0};
  test::ShapeField field_;
  Lattice lattice_{{0, 0, 2, 2}, 2};
  LabelTable table_{1};
  RayLedger ledger_{field_, nullptr, lattice_, table_, nullptr};
  Contrast contrast_{table_, kSteering};
  PointQueries queries_{ledger_, table_, contrast_, 1};
  Dither dither_;
  std::uint64_t asked_ = 0;

 public:
  TracedPixels pixels{4, 1000};
  CellTree tree{lattice_, queries_, pixels};
  BracketStore brackets{tree, contrast_, pixels, queries_, dither_, 0.04, 1};
};

Label beside(double x, double) { return x < 0.7 ? 1 : 2; }

TEST(CellTree, CellsOfOneLabelAreUniformTheOthersFresh) {
  Planted planted(beside);
  EXPECT_EQ(planted.tree.fresh_cells().size(), 4u);  // a column of cells
  for (const std::uint32_t cell : planted.tree.fresh_cells()) {
    EXPECT_EQ(planted.tree[cell].x, Lattice::side(0));
    std::uint32_t corner[4];
    planted.tree.corner_labels(planted.tree[cell], corner);
    EXPECT_EQ(corner[0], corner[3]);
    EXPECT_EQ(corner[1], corner[2]);
    EXPECT_NE(corner[0], corner[1]);
  }
  EXPECT_EQ(planted.tree[planted.number(0.2, 0.2)].kind, CellKind::uniform);
  EXPECT_EQ(planted.rays(), 0u);
}

TEST(CellTree, LeavesHoldTheirPointsAndVerticesAreTracedOnce) {
  Planted planted(beside);
  const std::uint32_t parent = planted.number(0.6, 0.1);
  planted.tree.split(parent);
  EXPECT_TRUE(planted.tree.look_at_vertices());
  EXPECT_EQ(planted.rays(), 5u) << "of nine vertices four were known";
  planted.tree.split(parent);  // has children already
  planted.tree.split(planted.number(0.6, 0.6));
  EXPECT_TRUE(planted.tree.look_at_vertices());
  EXPECT_EQ(planted.rays(), 9u) << "the neighbours share one";
  for (double x = 0.01; x < 2.0; x += 0.07)
    for (double y = 0.02; y < 2.0; y += 0.07) {
      const Cell& cell = planted.tree[planted.number(x, y)];
      const double unit = planted.tree.lattice().unit_px(), side = planted.tree.lattice().side_px(cell.level);
      EXPECT_LE(cell.x * unit, x);
      EXPECT_GE(cell.x * unit + side, x);
      EXPECT_LE(cell.y * unit, y);
      EXPECT_GE(cell.y * unit + side, y);
      EXPECT_NE(cell.kind, CellKind::split);
    }
  EXPECT_EQ(planted.tree.label_if_known(3 * Lattice::side(2), 0), kNoLabel) << "never asked";
  EXPECT_EQ(planted.tree.label_if_known(-1, 0), kNoLabel);
}

// A strip that crosses a side between two vertices shows where the cell on one side of it is split.
TEST(CellTree, WhatHangsOnASideSplitsTheNeighbour) {
  Planted planted([](double x, double y) -> Label { return std::abs(x - 0.75) < 0.05 && y < 0.9 ? 3 : 1; });
  EXPECT_TRUE(planted.tree.fresh_cells().empty());
  const std::uint32_t above = planted.number(0.6, 0.1), below = planted.number(0.6, 0.6);
  planted.tree.split(above);
  EXPECT_FALSE(planted.tree.look_at_vertices()) << "there is more to ask";
  EXPECT_EQ(planted.tree[below].kind, CellKind::split);
  EXPECT_TRUE(planted.pixels.suspect(0));
  EXPECT_EQ(planted.pixels.followed(0), 1);
  while (!planted.tree.look_at_vertices()) {
  }
  EXPECT_EQ(planted.tree[planted.number(0.1, 0.1)].kind, CellKind::uniform) << "nothing hangs there";
}

TEST(BracketStore, NeighboursShareTheCrossingOfTheirSide) {
  Planted planted(beside);
  const std::uint32_t above = planted.number(0.6, 0.1), below = planted.number(0.6, 0.6);
  for (const std::uint32_t cell : {above, below})
    planted.tree.corner_labels(planted.tree[cell], planted.tree[cell].corner);
  const std::uint32_t shared = planted.brackets.enter(above, 2);
  EXPECT_EQ(planted.brackets.enter(below, 0), shared);
  EXPECT_EQ(planted.brackets.size(), 1u);
  EXPECT_EQ(planted.brackets[shared].cells[0], above + 1);
  EXPECT_EQ(planted.brackets[shared].cells[1], below + 1);
  planted.brackets.locate(0);
  EXPECT_LE(planted.brackets[shared].width(), 0.06);
  EXPECT_LE(planted.brackets[shared].low, 0.2);  // from 0.5 px on
  EXPECT_GE(planted.brackets[shared].high, 0.2);
  EXPECT_NEAR(planted.brackets.end_point(shared).x, 0.7, 0.06);
}

// A crossing that is located need not be searched again on the halves of its side.
TEST(BracketStore, HalvesInheritTheCrossing) {
  Planted planted(beside);
  const std::uint32_t parent = planted.number(0.6, 0.1);
  planted.tree.corner_labels(planted.tree[parent], planted.tree[parent].corner);
  const std::uint32_t whole = planted.brackets.enter(parent, 0);
  planted.brackets.locate(0);
  planted.tree.split(parent);
  EXPECT_TRUE(planted.tree.look_at_vertices());
  const std::uint64_t before = planted.rays();
  const std::uint32_t child = planted.number(0.6, 0.1);
  planted.tree.corner_labels(planted.tree[child], planted.tree[child].corner);
  const std::uint32_t half = planted.brackets.enter(child, 0);
  EXPECT_NE(half, whole);
  planted.brackets.locate(half);
  EXPECT_EQ(planted.rays(), before);
  EXPECT_EQ(planted.brackets.middle_point(half).x, planted.brackets.middle_point(whole).x);
  EXPECT_EQ(planted.brackets[half].width(), planted.brackets[whole].width());
}

}  // namespace
}  // namespace ifov::sampling::test_cell_tree
