// Light that few paths find, in a strip along a wall's foot that lies between the rows of the lattice: what a pixel's own values
// have not met, those of the pixels beside it have.
#include <gtest/gtest.h>

#include <cmath>

#include "accuracy_scenes.h"
#include "faulty_samplers.h"
#include "sampling/accuracy/weights/block_sums.h"
#include "sampling/random.h"

namespace ifov::test::test_rare_light {
namespace {

using namespace sampling;

/// Ground below a wall's top: within `width_px` of the wall a path meets the wall with this probability.
class Foot final : public Field {
 public:
  Foot(double wall_px, double width_px) : wall_px_(wall_px), width_px_(width_px) {}

  int columns() const override { return 1; }
  void labels(std::span<const FocalPoint> points, std::span<Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) labels[k] = label(points[k]);
  }
  void values(std::span<const PathRequest> requests, std::span<Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const PathRequest& r = requests[k];
      labels[k] = label(r.point);
      const double u = unit_double(hash(hash(r.sequence, r.index), 1)),
                   noise = unit_double(hash(hash(r.sequence, r.index), 2));
      const bool foot = labels[k] == 1 && r.point.y_px > wall_px_ - width_px_;
      values[k * static_cast<std::size_t>(stride())] =
          static_cast<float>(kGround + 0.2 * (noise - 0.5) + (foot && u < kMeets ? kMore : 0.0));
    }
  }
  std::uint32_t material_of(Label label) const override { return static_cast<std::uint32_t>(label); }
  RayCounts counts() const override { return {}; }

  double mean() const { return kGround + kMore * kMeets * width_px_; }  // of the pixels below the wall
  static constexpr double kGround = 100.0, kMore = 60.0, kMeets = 0.25;

 private:
  Label label(FocalPoint p) const { return p.y_px < wall_px_ ? 1 : 2; }
  double wall_px_, width_px_;
};

struct Judged {
  int pixels = 0, off = 0, far_off = 0;
  double samples = 0.0;
};

Judged judge(const PixelSampler& sampler) {
  constexpr int kSide = 8, kRow = 4;
  Judged sum;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Foot field(kRow + 1.0, 0.05 + 0.1 * unit_double(hash(seed, 1)));
    const TileResult result = sampled_at_a_percent(field, kSide, seed, sampler);
    for (int x = 0; x < kSide; ++x) {
      const auto at = static_cast<std::size_t>(kRow * kSide + x);
      ++sum.pixels;
      sum.samples += result.samples[at];
      if (!result.converged(at)) continue;
      const double error = std::abs(static_cast<double>(result.mean[at]) - field.mean()),
                   half = static_cast<double>(result.half_width[at]);
      sum.off += error > half;
      sum.far_off += error > 3.0 * half;
    }
  }
  return sum;
}

TEST(RareLight, IsInTheIntervalsOfPixelsThatHaveMetNone) {
  const Judged sum = judge(AccuracySampler());
  EXPECT_LT(sum.off, 0.07 * sum.pixels) << sum.samples / sum.pixels;
  EXPECT_LT(sum.far_off, 0.01 * sum.pixels);
}

TEST(RareLight, PlantedFaultEachPixelIsAlone) {
  const Judged sum = judge(SamplerOf<NothingBesideTells>());
  EXPECT_GT(sum.far_off, 0.03 * sum.pixels)
      << sum.off << " of " << sum.pixels << " " << sum.samples / sum.pixels;
}

// One block of 25 with a value that is 60 off: its square, less what few blocks leave open. Noise has none on the whole.
TEST(RareLight, BlocksTellOfItsSquare) {
  BlockSums rare(1), noise(1);
  for (std::uint64_t b = 0; b < 25; ++b) {
    float values[4];
    const float* rows[4];
    for (std::uint64_t k = 0; k < 4; ++k) {
      values[k] = b == 7 && k == 2 ? 160.0f : 100.0f;
      rows[k] = &values[k];
    }
    rare.add_block({rows, 4});
  }
  EXPECT_NEAR(rare.rare(0), 3600.0 * (1.0 - 3.0 / 25.0), 1.0);
  for (std::uint64_t b = 0; b < 4000; ++b) {
    float values[4];
    const float* rows[4];
    for (std::uint64_t k = 0; k < 4; ++k) {
      values[k] = 0.0f;
      for (std::uint64_t i = 0; i < 12; ++i)
        values[k] += static_cast<float>(unit_double(hash(b, 12 * k + i)) - 0.5);
      rows[k] = &values[k];
    }
    noise.add_block({rows, 4});
  }
  EXPECT_LT(noise.rare(0), 1.5);
}

}  // namespace
}  // namespace ifov::test::test_rare_light
