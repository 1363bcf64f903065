#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "accuracy_scenes.h"
#include "sampling/accuracy/borders/junction.h"

namespace ifov::test::test_junction {
namespace {

using sampling::Point2;

TEST(Junction, LiesWhereItsBordersPointTo) {
  const Point2 at{0.31, 0.47};
  sampling::ExpectedLine lines[3];
  for (int i = 0; i < 3; ++i) {
    const Point2 along{std::cos(0.4 + 2.0 * i), std::sin(0.4 + 2.0 * i)};
    lines[i] = {{at.x - 0.3 * along.x, at.y - 0.3 * along.y}, along, 1e-8};
  }
  const Point2 found = sampling::meeting_point({0.5, 0.5}, 0.01, lines, 3);
  EXPECT_NEAR(found.x, at.x, 1e-5);
  EXPECT_NEAR(found.y, at.y, 1e-5);
  const Point2 unknown = sampling::meeting_point({0.5, 0.4}, 0.01, lines, 0);
  EXPECT_EQ(unknown.x, 0.5);
  EXPECT_EQ(unknown.y, 0.4);
}

// The areas of three sectors by the shoelace formula, before and after their meeting point moves.
TEST(Junction, SectorsExchangeWhatTheMotionOfTheirMeetingPointSweeps) {
  const Point2 crossing[3] = {{0.1, 0.0}, {1.0, 0.3}, {0.4, 1.0}};
  const double radiance[3] = {1.0, 4.0, 2.5};
  const auto weighted_area = [&](Point2 at) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i)
      sum += radiance[i] * 0.5 * sampling::cross(crossing[i] - at, crossing[(i + 1) % 3] - at);
    return sum;
  };
  const Point2 at{0.5, 0.4};
  const double by_x = weighted_area({1.5, 0.4}) - weighted_area(at),
               by_y = weighted_area({0.5, 1.4}) - weighted_area(at);
  double squares = 0.0;
  for (int border = 0; border < 3; ++border) {
    const double step = radiance[border] - radiance[(border + 2) % 3];
    squares += sampling::exchanged_by_motion(crossing, border) * step * step;
  }
  EXPECT_NEAR(squares, by_x * by_x + by_y * by_y, 1e-12);
}

/// Three sectors about a point in the middle pixel of 3 x 3, of radiance 0, 1 and 2.
struct SectorScene {
  Point2 at;
  double direction[3];  // rising; sector i lies between i and i + 1

  explicit SectorScene(std::uint64_t seed) {
    Draw draw(seed);
    at = {1.2 + 0.6 * draw(), 1.2 + 0.6 * draw()};
    const double first = 2.0 * std::numbers::pi * draw();
    direction[0] = first;
    direction[1] = first + (0.4 + 0.5 * draw()) * std::numbers::pi;
    direction[2] = first + (1.1 + 0.25 * draw()) * std::numbers::pi;
  }
  int sector(double x, double y) const {
    double angle = std::atan2(y - at.y, x - at.x) - direction[0];
    angle -= 2.0 * std::numbers::pi * std::floor(angle / (2.0 * std::numbers::pi));
    return angle < direction[1] - direction[0] ? 0 : angle < direction[2] - direction[0] ? 1 : 2;
  }
  double truth() const {
    double sum = 0.0;
    for (int i = 1; i < 3; ++i) {
      const double from = direction[i],
                   to = i == 2 ? direction[0] + 2.0 * std::numbers::pi : direction[i + 1];
      sampling::Polygon wedge;
      wedge.add(at);
      for (const double a : {from, 0.5 * (from + to), to})
        wedge.add({at.x + 9.0 * std::cos(a), at.y + 9.0 * std::sin(a)});
      sum += i * polygon_in_rectangle(wedge, 1.0, 1.0, 2.0, 2.0);
    }
    return sum;
  }
  ShapeField field() const {
    return {[*this](double x, double y) { return static_cast<sampling::Label>(sector(x, y)); },
            [](sampling::Label label, double, double, int) { return static_cast<float>(label); }};
  }
};

Trials sectors(double error, int trials) {
  Trials t;
  for (int i = 0; i < trials; ++i) {
    const SectorScene scene(700 + static_cast<std::uint64_t>(i));
    ShapeField field = scene.field();
    Rendering render = three_by_three(700 + static_cast<std::uint64_t>(i));
    render.half_width = error;
    t.add(render(field), scene.truth(), field);
  }
  return t;
}

// Splitting cells down to the junction took 334 and 476 rays over the nine pixels, and 36 rays at random.
TEST(Junction, IsFoundByFewRays) {
  for (const auto& [asked, most] : {std::pair{0.02, 320.0}, {0.002, 410.0}}) {
    const double error = asked;
    const Trials t = sectors(error, 200);
    EXPECT_LE(t.mean_samples(), most);
    EXPECT_GE(t.coverage(), 0.94);
    const auto wide = std::count_if(t.half_width.begin(), t.half_width.end(),
                                    [&](double h) { return h > 1.00001 * error; });
    EXPECT_LE(wide, 2);
    // Intervals that claim a third of theirs would not hold.
    int held = 0;
    for (std::size_t i = 0; i < t.error.size(); ++i) held += t.error[i] <= t.half_width[i] / 3.0;
    EXPECT_LT(held, 0.94 * static_cast<double>(t.error.size()));
  }
}

}  // namespace
}  // namespace ifov::test::test_junction
