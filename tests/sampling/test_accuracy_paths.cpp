#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "accuracy_scenes.h"
#include "faulty_samplers.h"
#include "sampling/sequence.h"

// Radiance that varies within labels: noise of paths, texture, gradients, and labels that do not tell all.

namespace ifov::test::test_accuracy_paths {
namespace {

/// A field whose paths are noisy: the value depends on the path's own numbers, not only on its point.
class NoisyField final : public sampling::Field {
 public:
  NoisyField(ShapeField base, double sigma) : base_(std::move(base)), sigma_(sigma) {}
  int columns() const override { return base_.columns(); }
  void labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) override {
    base_.labels(points, labels);
  }
  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override {
    base_.values(requests, labels, values);
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const std::uint64_t key = sampling::hash(requests[k].sequence, requests[k].index);
      const double u = sampling::unit_double(key), v = sampling::unit_double(sampling::mix(key));
      const double normal = std::sqrt(-2.0 * std::log(1.0 - u)) * std::cos(2.0 * std::numbers::pi * v);
      values[k * static_cast<std::size_t>(stride())] += static_cast<float>(sigma_ * normal);
    }
  }
  std::uint32_t material_of(sampling::Label label) const override { return base_.material_of(label); }
  sampling::RayCounts counts() const override { return base_.counts(); }

 private:
  ShapeField base_;
  double sigma_;
};

Trials noisy_discs(int trials, double limit_k) {
  Trials t;
  for (int i = 0; i < trials; ++i) {
    Draw draw(100 + static_cast<std::uint64_t>(i));
    const DiscScene scene{1.5 + (draw() - 0.5) * 0.2, 1.5 + (draw() - 0.5) * 0.2, half_pixel_radius()};
    NoisyField field(scene.field(), 0.3);
    Rendering render = three_by_three(100 + static_cast<std::uint64_t>(i));
    render.half_width = limit_k * kRadiancePerKelvin;
    t.add(render(field), scene.truth(), field);
  }
  return t;
}

TEST(AccuracyPaths, IntervalsHoldUnderPathNoise) {
  const Trials t = noisy_discs(200, 0.4);
  EXPECT_GE(t.coverage(), 0.93);
  double mean_half_width = 0.0;
  for (double h : t.half_width) mean_half_width += h / static_cast<double>(t.half_width.size());
  EXPECT_LE(mean_half_width, 3.0 * t.rms());
}

/// One surface under a sky: a value depends smoothly on where its path goes, and on nothing else.
class SkyField final : public sampling::Field {
 public:
  /// `one_sequence`: a fault, all paths of a pixel are of one sequence, whichever is asked for.
  explicit SkyField(bool one_sequence) : one_sequence_(one_sequence) {}
  int columns() const override { return 1; }
  void labels(std::span<const sampling::FocalPoint>, std::span<sampling::Label> labels) override {
    std::fill(labels.begin(), labels.end(), sampling::Label{1});
    counts_.primary += labels.size();
  }
  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const double x_px = requests[k].point.x_px, y_px = requests[k].point.y_px;
      const std::uint64_t sequence = one_sequence_ ? sampling::hash(static_cast<int>(std::floor(x_px)),
                                                                    static_cast<int>(std::floor(y_px)))
                                                   : requests[k].sequence;
      const sampling::Point2 u = sampling::sequence_point(sequence, requests[k].index, 2);
      labels[k] = 1;
      values[k * static_cast<std::size_t>(stride())] =
          static_cast<float>(kSky + std::cos(2.0 * std::numbers::pi * u.x) * u.y);
    }
    counts_.primary += requests.size();
  }
  std::uint32_t material_of(sampling::Label) const override { return 0; }
  sampling::RayCounts counts() const override { return counts_; }

  static constexpr double kSky = 10.0;

 private:
  bool one_sequence_;
  sampling::RayCounts counts_;
};

/// The centre pixel of 9 x 9 under a PSF of 0.6 px.
Trials skies(int trials, bool one_sequence = false) {
  Trials t;
  for (int i = 0; i < trials; ++i) {
    Rendering render = three_by_three(static_cast<std::uint64_t>(300 + i));
    render.tile = {3, 3, 6, 6};
    render.image = {0, 0, 9, 9};
    render.footprint = gaussian(0.6, 2.0);
    render.half_width = 0.02;
    SkyField field(one_sequence);
    t.add(render(field), SkyField::kSky, field);
  }
  return t;
}

// Paths of a round are stratified among themselves. Drawn apart they would need (2.3 * 0.41 / 0.02)^2 values that count
// under the footprint, 2200.
TEST(AccuracyPaths, SequencesOfPathsSaveSamplesUnderAPsf) {
  const Trials t = skies(150);
  EXPECT_GE(t.coverage(), 0.93);
  double mean_half_width = 0.0;
  for (double h : t.half_width) mean_half_width += h / static_cast<double>(t.half_width.size());
  EXPECT_LE(mean_half_width, 3.0 * t.rms());
  const double pixels = 49.0, seen = 4.0 * std::numbers::pi * 0.6 * 0.6;
  EXPECT_LT(t.mean_samples() * seen / pixels, 1100.0);
}

TEST(AccuracyPaths, ReplicatesOfOneSequenceMustNotTellTheirError) {
  EXPECT_LT(skies(60, true).coverage(), 0.9);
}

// A label of a single value that claims to be exact: paths of two very different radiances within one label.
TEST(AccuracyPaths, StrataOfOneSampleMustNotClaimToBeExact) {
  const auto coverage = [](bool fault) {
    int covered = 0;
    const int trials = 200;
    for (int i = 0; i < trials; ++i) {
      // Many small patches, each its own label, of noisy paths: most strata have one lattice value or none.
      const std::uint64_t seed = 900 + static_cast<std::uint64_t>(i);
      NoisyField field(
          ShapeField(
              [](double x, double y) {
                return static_cast<sampling::Label>(std::floor(x * 4.0) + 100.0 * std::floor(y * 4.0));
              },
              [](sampling::Label, double, double, int) { return 10.0f; }),
          0.3);
      Rendering render = three_by_three(seed);
      render.half_width = 0.5;
      render.options.clutter_switch = false;
      if (fault) render.sampler = make_sampler<SamplerOf<CertainSingles>>;
      const sampling::TileResult r = render(field);
      covered += std::abs(r.mean[4] - 10.0) <= r.half_width[4];
    }
    return covered / static_cast<double>(trials);
  };
  EXPECT_GE(coverage(false), 0.93);
  EXPECT_LT(coverage(true), 0.90);
}

double wave(double x, double y) {
  return 0.3 * std::sin(7.0 * x + 3.0 * y) + 0.3 * std::sin(23.0 * x - 17.0 * y + 1.0) +
         0.2 * std::cos(61.0 * y);
}

TEST(AccuracyPaths, IntervalsHoldOnTexture) {
  double truth = 0.0;
  const int n = 1000;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) truth += wave(1.0 + (i + 0.5) / n, 1.0 + (j + 0.5) / n) / (n * n);
  Trials t;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    ShapeField field(
        [](double, double) { return sampling::Label{1}; },
        [](sampling::Label, double x, double y, int) { return static_cast<float>(10.0 + wave(x, y)); });
    Rendering render = three_by_three(seed);
    render.half_width = 0.04;
    t.add(render(field), 10.0 + truth, field);
  }
  EXPECT_GE(t.coverage(), 0.93);
  // Independent values would need (2.4 * 0.33 / 0.04)^2 of them in each pixel at the tests' quantile.
  EXPECT_LT(t.mean_samples(), 9.0 * 392.0);
}

// A texture in step with the lattice looks the same at every vertex; only the values between show it.
TEST(AccuracyPaths, LabelsWithoutTheSunStateAreNotedByTheirVariance) {
  // Bit 8 of the label: the Sun is blocked. The border runs through the pixel.
  const auto render_with = [](sampling::Label mask, std::uint64_t seed) {
    ShapeField field(
        [mask](double x, double y) { return (sampling::Label{1} | (x + 0.3 * y < 2.0 ? 256u : 0u)) & mask; },
        [](sampling::Label, double x, double y, int) { return x + 0.3 * y < 2.0 ? 2.0f : 10.0f; });
    Rendering render = three_by_three(seed);
    render.half_width = 0.4;
    const sampling::TileResult r = render(field);
    return std::pair{std::abs(r.mean[4] - (2.0 + 8.0 * 0.45)) <= r.half_width[4] + 1e-6,
                     field.counts().primary};
  };
  int covered = 0, blind = 0;
  std::uint64_t rays = 0, blind_rays = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const auto [held, n] = render_with(~sampling::Label{0}, seed);
    const auto [blind_held, m] = render_with(255, seed);
    covered += held;
    blind += blind_held;
    rays += n;
    blind_rays += m;
  }
  EXPECT_GE(covered, 93);
  EXPECT_GE(blind, 90);             // labels steer, they do not bias
  EXPECT_GT(blind_rays, 3 * rays);  // but steering badly costs
}

}  // namespace
}  // namespace ifov::test::test_accuracy_paths
