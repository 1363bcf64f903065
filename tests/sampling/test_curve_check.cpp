#include <gtest/gtest.h>

#include "sampling/accuracy/edges/curve_check.h"

namespace ifov::sampling::test_curve_check {
namespace {

Point2 at(const FocalPoint& p) { return {p.x_px, p.y_px}; }

/// A chord from (0, 0) to (2, 0) whose border was taken for a shallow arc above it.
CurveCheck arc() {
  CurveCheck check;
  check.ends = {{0.0, 0.0}, {2.0, 0.0}};
  check.centre = {1.0, 0.0};
  check.normal = {0.0, 1.0};
  check.chord = 2.0;
  check.tolerance = check.blur = 0.01;
  check.predicted = 0.1;
  check.far = 1;
  check.near = 2;
  return check;
}

// Looked for on the line from the chord's middle to its apex: just beyond that and just before it, then on both sides
// of both legs.
TEST(CurveCheck, ACornerIsLookedForAtItsApexAndItsLegs) {
  for (const double height : {0.7, -0.7}) {
    CurveCheck check = arc();
    check.apex = {1.3, height};
    check.try_corner();
    EXPECT_EQ(check.far, height > 0.0 ? 1u : 2u);  // of the apex, seen from the chord
    std::vector<FocalPoint> points;
    check.add_points(points);
    ASSERT_EQ(points.size(), 2u);
    const double reach = length(check.apex - check.centre);
    EXPECT_NEAR(length(at(points[0]) - check.centre), reach + check.tolerance, 1e-12);
    EXPECT_NEAR(length(at(points[1]) - check.centre), reach - check.tolerance, 1e-12);
    for (const FocalPoint& point : points)
      EXPECT_NEAR(length(at(point) - check.apex), check.tolerance, 1e-12);

    check.low = check.high = reach;
    check.stage = CurveCheck::Stage::legs;
    points.clear();
    check.add_points(points);
    ASSERT_EQ(points.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k) {
      const Point2 end = k < 2 ? check.ends.a : check.ends.b;
      EXPECT_NEAR(distance_to_segment(at(points[k]), end, check.apex), check.tolerance, 1e-12);
      const double side = cross(check.apex - end, at(points[k]) - end);
      const double middle = cross(check.apex - end, check.centre - end);
      EXPECT_EQ(side * middle < 0.0, k % 2 == 0) << k;  // the far side first
    }
  }
}

}  // namespace
}  // namespace ifov::sampling::test_curve_check
