// Rows in step with the lattice, against exact areas: what nine points at fixed thirds of a pixel see of them is nobody's
// share.
#include <gtest/gtest.h>

#include <cmath>

#include "accuracy_scenes.h"

namespace ifov::test::test_accuracy_rows {
namespace {

using namespace sampling;

struct Rows {
  double pitch_px, duty, angle_rad, phase;
  bool apart;  ///< every row is an object of its own
  double bright = 0.3, dark = 0.05;

  double place(double x, double y) const {
    return (std::cos(angle_rad) * x + std::sin(angle_rad) * y) / pitch_px + phase;
  }
  Label label(double x, double y) const {
    const double at = place(x, y), row = std::floor(at);
    if (at - row >= duty) return 1;
    return apart ? 2 + 2 * static_cast<Label>(row + 100000.0) : 2;
  }
  ShapeField field() const {
    return {[*this](double x, double y) { return label(x, y); },
            [*this](Label l, double, double, int) { return static_cast<float>(l % 2 == 0 ? dark : bright); }};
  }
  /// Mean over pixel (i, j) by the exact areas of the rows in it.
  double mean(int i, int j) const {
    double low = INFINITY, high = -INFINITY, area = 0.0;
    for (int c = 0; c < 4; ++c) {
      const double at = place(i + c % 2, j + c / 2);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    Polygon pixel;
    for (const Point2 p : {Point2{0, 0}, {1, 0}, {1, 1}, {0, 1}}) pixel.add({i + p.x, j + p.y});
    const double a = std::cos(angle_rad) / pitch_px, b = std::sin(angle_rad) / pitch_px;
    for (double k = std::floor(low) - 1.0; k <= high + 1.0; k += 1.0)
      area += std::abs(pixel.clipped(-a, -b, phase - k).clipped(a, b, k + duty - phase).signed_area());
    return area * dark + (1.0 - area) * bright;
  }
};

struct Judged {
  double pixels = 0.0, converged = 0.0, off = 0.0, far_off = 0.0, bias = 0.0;
};

void judge(const Rows& rows, std::uint64_t seed, const PixelSampler& sampler, Judged& sum) {
  constexpr int kSide = 10;
  ShapeField field = rows.field();
  const TileResult result = sampled_at_a_percent(field, kSide, seed, sampler);
  for (std::size_t p = 0; p < result.mean.size(); ++p) {
    sum.pixels += 1.0;
    if (!result.converged(p)) continue;
    const double truth = rows.mean(static_cast<int>(p) % kSide, static_cast<int>(p) / kSide);
    const double rounding = 2e-6 * truth;  // of single precision
    const double error = static_cast<double>(result.mean[p]) - truth,
                 half = static_cast<double>(result.half_width[p]);
    sum.converged += 1.0;
    sum.off += std::abs(error) > half + rounding;
    sum.far_off += std::abs(error) > 5.0 * half + rounding;
    sum.bias += error / truth;
  }
}

// Ten-metre rows, nine tenths crop, under pixels of 30 m; vineyards at their own pitch; wider and narrower ones.
Judged judge_aligned(const PixelSampler& sampler) {
  Judged sum;
  std::uint64_t seed = 0;
  for (const double pitch : {1.0 / 3.0, 0.5, 1.0, 4.0 / 3.0, 2.0})
    for (const double duty : {0.1, 0.3, 0.9})
      for (const double angle : {0.0, 0.001})
        for (const bool apart : {false, true}) judge({pitch, duty, angle, 0.9, apart}, ++seed, sampler, sum);
  return sum;
}

TEST(AccuracyRows, InStepWithTheLatticeAreRight) {
  const Judged sum = judge_aligned(AccuracySampler());
  EXPECT_GT(sum.converged, 0.95 * sum.pixels);
  EXPECT_LT(sum.off, 0.07 * sum.converged);
  EXPECT_LT(sum.far_off, 0.002 * sum.converged);
  EXPECT_LT(std::abs(sum.bias), 1e-3 * sum.converged);
}

TEST(AccuracyRows, WithoutRandomRaysAreCaught) {
  AccuracyOptions without;
  without.random_rays_per_side = 0;
  const Judged sum = judge_aligned(AccuracySampler(without));
  EXPECT_GT(sum.far_off, 0.05 * sum.converged);
}

// Many borders at the same distance from the vertices of all pixels: their errors must not agree.
TEST(AccuracyRows, CrossingsAtLikePlacesDoNotErrAlike) {
  Judged sum;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    judge({0.2, 0.613, 0.0, 0.862 + 0.01 * static_cast<double>(seed), true}, seed, AccuracySampler(), sum);
  EXPECT_GT(sum.converged, 0.95 * sum.pixels);
  EXPECT_LT(sum.off, 0.07 * sum.converged);
  EXPECT_LT(std::abs(sum.bias), 1.5e-3 * sum.converged);
}

}  // namespace
}  // namespace ifov::test::test_accuracy_rows
