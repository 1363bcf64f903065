// A mirror dome smaller than a pixel: the sky in its middle, and dark ground about it that looks like the ground it stands on.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy_scenes.h"

namespace ifov::test {
namespace {

using namespace sampling;

constexpr double kSky = 24.0, kMiddle_px = 0.283, kRim_px = 0.4, kHalfWidth = 0.38;

class Dome final : public Field {
 public:
  Dome(double x_px, double y_px, bool tells_sky) : x_px_(x_px), y_px_(y_px), tells_sky_(tells_sky) {}
  int columns() const override { return 1; }
  void labels(std::span<const FocalPoint> points, std::span<Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) labels[k] = label(points[k]);
  }
  void values(std::span<const PathRequest> requests, std::span<Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      labels[k] = label(requests[k].point);
      values[k * static_cast<std::size_t>(stride())] = labels[k] == 3 ? static_cast<float>(kSky) : 0.0f;
    }
  }
  std::uint32_t material_of(Label label) const override { return label == 1 ? 0 : 1; }
  bool uneven(Label label) const override { return label == 2; }
  
  RayCounts counts() const override { return {}; }

 private:
  Label label(FocalPoint p) const {
    const double r = std::hypot(p.x_px - x_px_, p.y_px - y_px_);
    return r < kMiddle_px ? 3 : r < kRim_px ? 2 : 1;
  }
  double x_px_, y_px_;
  bool tells_sky_;
};

struct Judged {
  int domes = 0, held = 0;
  double samples = 0.0, most = 0.0, error = 0.0;
};

Judged judge(bool tells_sky) {
  constexpr double kTruth = kSky * std::numbers::pi * kMiddle_px * kMiddle_px;
  Judged sum;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Dome field(1.4 + 0.2 * unit_double(hash(seed, 1)), 1.4 + 0.2 * unit_double(hash(seed, 2)), tells_sky);
    Rendering render = three_by_three(seed);
    render.half_width = kHalfWidth;
    const TileResult result = render(field);
    const double error = static_cast<double>(result.mean[4]) - kTruth,
                 samples = static_cast<double>(result.samples[4]);
    ++sum.domes;
    sum.held += std::abs(error) <= static_cast<double>(result.half_width[4]);
    sum.error += error / kTruth;
    sum.samples += samples;
    sum.most = std::max(sum.most, samples);
  }
  sum.samples /= sum.domes;
  sum.error /= sum.domes;
  return sum;
}

TEST(AccuracyRings, MirrorDomesTakeFewSamplesAndHold) {
  const Judged sum = judge(true);
  EXPECT_GE(sum.held, 0.93 * sum.domes);
  EXPECT_LE(sum.samples, 200.0);
  EXPECT_LE(sum.most, 800.0);
  EXPECT_LT(std::abs(sum.error), 0.004);
}

/// What the rim might show is then as bright as the sky.
TEST(AccuracyRings, PlantedFaultASkyThatIsNotTold) {
  const Judged sum = judge(false);
  EXPECT_GE(sum.held, 0.93 * sum.domes);
  EXPECT_GT(sum.samples, 250.0);
}

}  // namespace
}  // namespace ifov::test
