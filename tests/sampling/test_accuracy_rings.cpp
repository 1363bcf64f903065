// A mirror dome smaller than a pixel: the sky in its middle, and about it a ring that shows the dark ground, or in places something bright that
// stands beside.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy_scenes.h"

namespace ifov::test::test_accuracy_rings {
namespace {

using namespace sampling;

constexpr int kDomes = 1200;
constexpr double kSky = 24.0, kMiddle_px = 0.283, kRim_px = 0.4, kHalfWidth = 0.38;

struct DomeShape {
  double x_px = 0.0, y_px = 0.0;
  double from = 0.0,
         thing =
             0.0;  ///< where what stands beside begins in the ring, and how much of the ring it takes; rad
  bool tells_uneven = true;
};

class Dome final : public Field {
 public:
  explicit Dome(const DomeShape& shape) : shape_(shape) {}
  int columns() const override { return 1; }
  void labels(std::span<const FocalPoint> points, std::span<Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) labels[k] = label(points[k]);
  }
  void values(std::span<const PathRequest> requests, std::span<Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const FocalPoint at = requests[k].point;
      labels[k] = label(at);
      const bool bright = labels[k] == 3 || (labels[k] == 2 && shows_thing(at));
      values[k * static_cast<std::size_t>(stride())] = bright ? static_cast<float>(kSky) : 0.0f;
    }
  }
  std::uint32_t material_of(Label label) const override { return label == 1 ? 0 : 1; }
  bool uneven(Label label) const override { return label == 2 && shape_.tells_uneven; }
  RayCounts counts() const override { return {}; }

 private:
  Label label(FocalPoint p) const {
    const double r = std::hypot(p.x_px - shape_.x_px, p.y_px - shape_.y_px);
    return r < kMiddle_px ? 3 : r < kRim_px ? 2 : 1;
  }
  bool shows_thing(FocalPoint p) const {
    const double angle = std::atan2(p.y_px - shape_.y_px, p.x_px - shape_.x_px) - shape_.from;
    return angle - 2.0 * std::numbers::pi * std::floor(angle / (2.0 * std::numbers::pi)) < shape_.thing;
  }

  DomeShape shape_;
};

struct Judged {
  int sure = 0, held = 0;             ///< of kDomes
  double samples = 0.0, error = 0.0;  ///< means; the error as share of the truth
};

Judged judge(double most_of_ring, bool tells_uneven) {
  Judged sum;
  for (std::uint64_t seed = 1; seed <= kDomes; ++seed) {
    const auto draw = [&](std::uint64_t number) { return unit_double(hash(seed, number)); };
    const DomeShape shape{1.4 + 0.2 * draw(1), 1.4 + 0.2 * draw(2), 2.0 * std::numbers::pi * draw(3),
                          most_of_ring * draw(4), tells_uneven};
    const double truth = kSky * (std::numbers::pi * kMiddle_px * kMiddle_px +
                                 0.5 * shape.thing * (kRim_px * kRim_px - kMiddle_px * kMiddle_px));
    Dome field(shape);
    Rendering render = three_by_three(seed);
    render.half_width = kHalfWidth;
    const TileResult result = render(field);
    const double error = static_cast<double>(result.mean[4]) - truth,
                 half_width = static_cast<double>(result.half_width[4]);
    sum.sure += half_width <= kHalfWidth;
    sum.held += std::abs(error) <= half_width;
    sum.error += error / truth / kDomes;
    sum.samples += static_cast<double>(result.samples[4]) / kDomes;
  }
  return sum;
}

TEST(AccuracyRings, MirrorDomesHold) {
  const Judged sum = judge(0.0, true);
  EXPECT_GE(sum.sure, 0.95 * kDomes);
  EXPECT_GE(sum.held, 0.93 * kDomes);
  EXPECT_LE(sum.samples, 420.0);
  EXPECT_LT(std::abs(sum.error), 0.004);
}

/// What stands beside is met by few of the first rays, or by none.
TEST(AccuracyRings, WhatIsSeenOnlyInTheMirrorIsInTheInterval) {
  const Judged sum = judge(1.0, true);
  EXPECT_GE(sum.sure, 0.5 * kDomes);
  EXPECT_GE(sum.held, 0.93 * kDomes);
}

TEST(AccuracyRings, PlantedFaultARingThatIsSaidToBeEven) {
  const Judged sum = judge(1.0, false);
  EXPECT_LT(sum.held, 0.6 * kDomes);
}

}  // namespace
}  // namespace ifov::test::test_accuracy_rings
