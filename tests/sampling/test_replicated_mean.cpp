#include <gtest/gtest.h>

#include <cmath>

#include "sampling/means/replicated_mean.h"

namespace ifov::test_replicated_mean {
namespace {

using sampling::Point2;

/// Of a disc of this radius about the middle, as a function over the square.
auto disc(double radius) {
  return [radius](std::span<const Point2> points, std::span<double> values) {
    for (std::size_t k = 0; k < points.size(); ++k)
      values[k] = std::hypot(points[k].x - 0.5, points[k].y - 0.5) < radius ? 1.0 : 0.0;
  };
}

/// How often of 400 keys the interval, this much as wide, holds the area.
double held(double radius, double limit, double width) {
  const double area = 3.141592653589793 * radius * radius;
  int count = 0;
  for (std::uint64_t key = 0; key < 400; ++key) {
    const auto mean = sampling::replicated_mean(key, 0.95, limit, 1u << 16, disc(radius));
    count += std::abs(mean.mean - area) <= width * mean.half_width;
  }
  return count / 400.0;
}

TEST(ReplicatedMean, IntervalsHold) {
  for (const double radius : {0.02, 0.3, 0.45}) EXPECT_GE(held(radius, 0.01, 1.0), 0.95) << radius;
  EXPECT_GE(held(0.3, 0.002, 1.0), 0.95);
  EXPECT_LT(held(0.3, 0.01, 0.4), 0.95);  // the same test of narrower ones
}

TEST(ReplicatedMean, GoesOnUntilItIsAsNearAsAsked) {
  const auto coarse = sampling::replicated_mean(7, 0.95, 0.05, 1u << 20, disc(0.3));
  const auto fine = sampling::replicated_mean(7, 0.95, 5e-4, 1u << 20, disc(0.3));
  EXPECT_LE(coarse.half_width, 0.05);
  EXPECT_LE(fine.half_width, 5e-4);
  EXPECT_EQ(coarse.samples, 1024u);
  EXPECT_GT(fine.samples, 8192u);
  EXPECT_LE(sampling::replicated_mean(7, 0.95, 1e-9, 1u << 14, disc(0.3)).samples, (1u << 14) + (1u << 13));
}

TEST(ReplicatedMean, SameValuesAreNotTakenForCertain) {
  const auto none = sampling::replicated_mean(3, 0.95, 0.01, 1u << 14, disc(0.0));
  EXPECT_EQ(none.mean, 0.0);
  EXPECT_DOUBLE_EQ(none.half_width, 3.0 / 1024.0);
}

}  // namespace
}  // namespace ifov::test_replicated_mean
