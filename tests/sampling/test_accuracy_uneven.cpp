// Narrow things whose values vary beside wide ones whose values do not: what is known of the one is nothing about the other.
#include <gtest/gtest.h>

#include <cmath>

#include "accuracy_scenes.h"
#include "faulty_samplers.h"
#include "sampling/random.h"

namespace ifov::test::test_accuracy_uneven {
namespace {

using namespace sampling;

/// Level ground in the Sun and in shadow, with a penumbra between them in which a path meets the Sun with a chance that
/// rises evenly across it.
struct Penumbra {
  double begin_px, width_px, slope;
  double lit = 100.0, dark = 10.0;

  double across(double x, double y) const { return (y - slope * x - begin_px) / width_px; }
  class Field final : public sampling::Field {
   public:
    Field(const Penumbra& scene, bool knows_uneven) : scene_(scene), knows_uneven_(knows_uneven) {}
    int columns() const override { return 1; }
    void labels(std::span<const FocalPoint> points, std::span<Label> labels) override {
      for (std::size_t k = 0; k < points.size(); ++k) labels[k] = label(points[k]);
    }
    void values(std::span<const PathRequest> requests, std::span<Label> labels,
                std::span<float> values) override {
      for (std::size_t k = 0; k < requests.size(); ++k) {
        const PathRequest& r = requests[k];
        labels[k] = label(r.point);
        const double chance = scene_.across(r.point.x_px, r.point.y_px);
        const bool sees =
            unit_double(hash(r.sequence, r.index, static_cast<std::uint64_t>(r.point.x_px * 1e9))) < chance;
        values[k * static_cast<std::size_t>(stride())] = static_cast<float>(sees ? scene_.lit : scene_.dark);
      }
    }
    std::uint32_t material_of(Label) const override { return 0; }
    bool uneven(Label label) const override { return knows_uneven_ && label == 2; }
    RayCounts counts() const override { return {}; }

   private:
    Label label(FocalPoint p) const {
      const double at = scene_.across(p.x_px, p.y_px);
      return at < 0.0 ? 1 : at < 1.0 ? 2 : 3;
    }
    const Penumbra& scene_;
    bool knows_uneven_;
  };
  /// Mean over pixel (i, j), to a part in 1e5.
  double mean(int i, int j) const {
    constexpr int kSteps = 400;
    double sum = 0.0;
    for (int b = 0; b < kSteps; ++b)
      for (int a = 0; a < 8; ++a)
        sum += std::clamp(across(i + (a + 0.5) / 8.0, j + (b + 0.5) / kSteps), 0.0, 1.0);
    return dark + (lit - dark) * sum / (8.0 * kSteps);
  }
};

struct Judged {
  int pixels = 0, converged = 0, off = 0, far_off = 0;
};

Judged judge(const PixelSampler& sampler, bool knows_uneven) {
  constexpr int kSide = 8;
  Judged sum;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Penumbra scene{3.0 + unit_double(hash(seed, 1)), 0.05 + 0.4 * unit_double(hash(seed, 2)),
                         seed % 3 == 0 ? 0.0 : 0.05 * unit_double(hash(seed, 3))};
    Penumbra::Field field(scene, knows_uneven);
    const TileResult result = sampled_at_a_percent(field, kSide, seed, sampler);
    for (int p = 0; p < kSide * kSide; ++p) {
      const auto at = static_cast<std::size_t>(p);
      const double truth = scene.mean(p % kSide, p / kSide);
      if (truth == scene.lit || truth == scene.dark) continue;
      ++sum.pixels;
      if (!result.converged(at)) continue;
      ++sum.converged;
      const double error = std::abs(static_cast<double>(result.mean[at]) - truth),
                   half = static_cast<double>(result.half_width[at]);
      sum.off += error > half + 1e-4 * truth;
      sum.far_off += error > 3.0 * half + 1e-4 * truth;
    }
  }
  return sum;
}

TEST(AccuracyUneven, NarrowPenumbraeBesideLevelGroundAreRight) {
  const Judged sum = judge(AccuracySampler(), true);
  EXPECT_GT(sum.pixels, 400);
  EXPECT_GT(sum.converged, 0.95 * sum.pixels);
  EXPECT_LT(sum.off, 0.07 * sum.converged);
  EXPECT_LE(sum.far_off, 0.004 * sum.converged);
}

TEST(AccuracyUneven, PlantedFaultOtherLabelsTellHowTheyVary) {
  const Judged sum = judge(SamplerOf<OtherLabelsTell>(), false);
  EXPECT_GT(sum.off, 0.12 * sum.converged);
  EXPECT_GT(sum.far_off, 0.03 * sum.converged);
}

/// The shadow of a wire, all penumbra: a strip of label 2 across level ground in the Sun, in which half of all paths meet it.
class WireShadow final : public Field {
 public:
  /// Of meeting the wire: a half everywhere, or from nothing at the rims to all in the middle.
  enum class Chance { even, rising };
  WireShadow(double begin_px, double width_px, Chance chance, bool knows_uneven)
      : begin_px_(begin_px), width_px_(width_px), chance_(chance), knows_uneven_(knows_uneven) {}
  int columns() const override { return 1; }
  void labels(std::span<const FocalPoint> points, std::span<Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) labels[k] = inside(points[k]) ? 2 : 1;
  }
  void values(std::span<const PathRequest> requests, std::span<Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const PathRequest& r = requests[k];
      labels[k] = inside(r.point) ? 2 : 1;
      const double t = (r.point.y_px - begin_px_) / width_px_,
                   chance = chance_ == Chance::even ? 0.5 : 1.0 - std::abs(2.0 * t - 1.0);
      const bool hidden = labels[k] == 2 && unit_double(hash(r.sequence, r.index, 7)) < chance;
      values[k * static_cast<std::size_t>(stride())] = hidden ? kDark : kLit;
    }
  }
  std::uint32_t material_of(Label) const override { return 0; }
  bool uneven(Label label) const override { return knows_uneven_ && label == 2; }
  RayCounts counts() const override { return {}; }

  static constexpr float kLit = 100.0f, kDark = 10.0f;

 private:
  bool inside(FocalPoint p) const { return p.y_px >= begin_px_ && p.y_px < begin_px_ + width_px_; }
  double begin_px_, width_px_;
  Chance chance_;
  bool knows_uneven_;
};

/// Of 40 strips 0.04 to 0.06 px wide, to which pilot rays are sent: pixels that are sure, and of them those that are off.
Judged wire_shadows(WireShadow::Chance chance, bool knows_uneven) {
  constexpr int kSide = 3;
  Judged sum;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const double begin = 1.3 + 0.05 * unit_double(hash(seed, 1)),
                 width = 0.04 + 0.02 * unit_double(hash(seed, 2));
    WireShadow field(begin, width, chance, knows_uneven);
    // Where the chance is not the same everywhere they meet the strip near its rim, where the Sun is hardly hidden.
    const double met = chance == WireShadow::Chance::even ? 0.5 : 0.04;
    std::vector<FocalPoint> points;
    for (double x = 0.1; x < kSide; x += 0.35) points.push_back({x, begin + met * width});
    const std::vector<std::uint32_t> objects(points.size(), Field::kNoObject);
    const TileResult result = sampled_at_a_percent(field, kSide, seed, AccuracySampler(), points, objects);
    const double truth = WireShadow::kLit - 0.5 * width * (WireShadow::kLit - WireShadow::kDark);
    for (int i = 0; i < kSide; ++i) {
      const auto at = static_cast<std::size_t>(kSide + i);
      ++sum.pixels;
      if (!result.converged(at)) continue;
      ++sum.converged;
      sum.off +=
          std::abs(static_cast<double>(result.mean[at]) - truth) > static_cast<double>(result.half_width[at]);
    }
  }
  return sum;
}

// The one value by which a label that is found late was known may be the Sun's, as on the ground beside it.
TEST(AccuracyUneven, ThinPenumbraeThatPilotRaysMeetAreRight) {
  const Judged sum = wire_shadows(WireShadow::Chance::even, true);
  EXPECT_GT(sum.converged, 0.95 * sum.pixels);
  EXPECT_LT(sum.off, 0.05 * sum.converged);
}

// Those of one place near its rim may all be the Sun's, however many they are: the place tells as little as one value does.
TEST(AccuracyUneven, ThinPenumbraeThatPilotRaysMeetAtTheirRimsAreRight) {
  const Judged sum = wire_shadows(WireShadow::Chance::rising, true);
  EXPECT_GT(sum.converged, 0.95 * sum.pixels);
  EXPECT_LT(sum.off, 0.05 * sum.converged);
}

TEST(AccuracyUneven, PlantedFaultOnePlaceTellsOfAPenumbra) {
  EXPECT_GT(wire_shadows(WireShadow::Chance::rising, false).off, 0.15 * 3 * 40);
}

TEST(AccuracyUneven, PlantedFaultOneValueTellsOfAPenumbra) {
  EXPECT_GT(wire_shadows(WireShadow::Chance::even, false).off,
            0.18 * 3 * 40);  // 23; values that meet what looks alike count
}

/// A cable along the columns, darker on one side and lighter on the other than the ground: 1 + 0.8 sin(2 pi t), t from -1 to 1 across
/// it. Vertices that stand in it all have one t, and one that lies between them is met by pilot rays at one t.
Judged wires_in_step(const PixelSampler& sampler) {
  constexpr int kSide = 3;
  constexpr double kGround = 100.0;
  const auto grain = [](double x, double y) {
    return unit_double(hash(3, static_cast<std::int64_t>(1e6 * x), static_cast<std::int64_t>(1e6 * y))) - 0.5;
  };
  Judged sum;
  for (std::uint64_t seed = 1; seed <= 160; ++seed) {
    const double width = 0.03 + 0.05 * unit_double(hash(seed, 1));
    // The vertices' column, or the pilot rays, at t from -0.35 to -0.15.
    const double t = -0.35 + 0.2 * unit_double(hash(seed, 2));
    const double met = seed % 2 == 0 ? 1.0 + 1.0 / 3.0 : 1.5, middle = met - 0.5 * t * width;
    const auto across = [&](double x) { return 2.0 * (x - middle) / width; };
    ShapeField field([&](double x, double) { return Label{std::abs(across(x)) < 1.0 ? 2u : 1u}; },
                     [&](Label label, double x, double y, int) {
                       const double shade = label == 2 ? 1.0 + 0.8 * std::sin(2.0 * M_PI * across(x)) : 1.0;
                       return static_cast<float>(kGround * shade + 0.1 * grain(x, y));
                     });
    std::vector<FocalPoint> points;
    for (double y = 0.1; y < kSide; y += 0.35) points.push_back({met, y});
    const std::vector<std::uint32_t> objects(points.size(), Field::kNoObject);
    const TileResult result = sampled_at_a_percent(field, kSide, seed, sampler, points, objects);
    for (int j = 0; j < kSide; ++j) {
      const auto at = static_cast<std::size_t>(kSide * j + 1);
      const double error = std::abs(static_cast<double>(result.mean[at]) - kGround),
                   half = static_cast<double>(result.half_width[at]);
      ++sum.pixels;
      if (!result.converged(at)) continue;
      ++sum.converged;
      sum.off += error > half + 0.01;
      sum.far_off += error > 2.0 * half + 0.01;
    }
  }
  return sum;
}

TEST(AccuracyUneven, WiresInStepWithTheLatticeAreRight) {
  const Judged sum = wires_in_step(AccuracySampler());
  EXPECT_GT(sum.converged, 0.95 * sum.pixels);
  EXPECT_LE(sum.off, 0.05 * sum.converged);
  EXPECT_LE(sum.far_off, 0.03 * sum.converged);
}

TEST(AccuracyUneven, PlantedFaultVerticesInLineTellOfAWire) {
  const Judged sum = wires_in_step(SamplerOf<FewVerticesTell>());
  EXPECT_GT(sum.far_off, 0.2 * sum.converged);
}

class LitField final : public ShapeField {
 public:
  using ShapeField::ShapeField;
  bool may_be_shaded(Label) const override { return true; }
};

/// A ball of 0.1 px in each pixel, of a label of its own, which the Sun lights from one side; pilot rays meet their middles, which are
/// dark. Each of them adds nearly as much as may be wrong.
Judged balls_lit_from_one_side(const PixelSampler& sampler) {
  constexpr int kSide = 8;
  constexpr double kGround = 100.0, kRadius = 0.055, kBrightest = 450.0;
  Judged sum;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    std::vector<FocalPoint> middles;
    for (int p = 0; p < kSide * kSide; ++p)
      middles.push_back({p % kSide + 0.1 + 0.8 * unit_double(hash(seed, p, 1)),
                         p / kSide + 0.1 + 0.8 * unit_double(hash(seed, p, 2))});
    const auto ball_at = [&](double x, double y) {
      const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y)), p = kSide * j + i;
      if (i < 0 || j < 0 || i >= kSide || j >= kSide) return -1;
      const FocalPoint at = middles[static_cast<std::size_t>(p)];
      return std::hypot(x - at.x_px, y - at.y_px) < kRadius ? p : -1;
    };
    LitField field([&](double x, double y) { return Label{static_cast<std::uint32_t>(2 + ball_at(x, y))}; },
                   [&](Label label, double x, double, int) {
                     if (label < 2) return static_cast<float>(kGround);
                     const double across = (x - middles[label - 2].x_px) / kRadius,
                                  lit = std::max(0.0, across);
                     return static_cast<float>(kBrightest * lit);
                   });
    const std::vector<std::uint32_t> objects(middles.size(), Field::kNoObject);
    const TileResult result = sampled_at_a_percent(field, kSide, seed, sampler, middles, objects);
    // Over a disc the mean of a coordinate, where it is above 0, is 2 / (3 pi) radii.
    const double truth = kGround + M_PI * kRadius * kRadius * (kBrightest * 2.0 / (3.0 * M_PI) - kGround);
    for (std::size_t p = 0; p < middles.size(); ++p) {
      const double error = std::abs(static_cast<double>(result.mean[p]) - truth),
                   half = static_cast<double>(result.half_width[p]);
      ++sum.pixels;
      if (!result.converged(p)) continue;
      ++sum.converged;
      sum.off += error > half;
      sum.far_off += error > 2.0 * half;
    }
  }
  return sum;
}

TEST(AccuracyUneven, SmallBallsOfManyShadesAreRight) {
  const Judged sum = balls_lit_from_one_side(AccuracySampler());
  EXPECT_GT(sum.converged, 0.95 * sum.pixels);
  EXPECT_LE(sum.off, 0.05 * sum.converged);
  EXPECT_LE(sum.far_off, 0.01 * sum.converged);
}

TEST(AccuracyUneven, PlantedFaultOneShadeTellsOfABall) {
  const Judged sum = balls_lit_from_one_side(SamplerOf<FewVerticesTell>());
  EXPECT_GT(sum.far_off, 0.2 * sum.converged);
}

/// A strip of penumbra in which some paths meet what no label of a point tells of; it remembers how far from a tile's middle it was
/// asked.
class MetByPathsAlone final : public Field {
 public:
  explicit MetByPathsAlone(FocalPoint middle) : middle_(middle) {}
  int columns() const override { return 1; }
  void labels(std::span<const FocalPoint> points, std::span<Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) labels[k] = label(points[k]);
  }
  void values(std::span<const PathRequest> requests, std::span<Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const PathRequest& r = requests[k];
      farthest_ =
          std::max({farthest_, std::abs(r.point.x_px - middle_.x_px), std::abs(r.point.y_px - middle_.y_px)});
      const std::uint64_t drawn = hash(r.sequence, r.index, static_cast<std::uint64_t>(r.point.x_px * 1e9));
      labels[k] = label(r.point) == 2 && drawn % 3 == 0 ? 10 + drawn % 7 : label(r.point);
      values[k * static_cast<std::size_t>(stride())] =
          labels[k] == 1 ? 100.0f : 20.0f + 80.0f * static_cast<float>(unit_double(drawn));
    }
  }
  std::uint32_t material_of(Label) const override { return 0; }
  bool uneven(Label label) const override { return label != 1; }
  RayCounts counts() const override { return {}; }
  double farthest_px() const { return farthest_; }

 private:
  static Label label(FocalPoint p) { return std::abs(p.y_px - 0.3 * p.x_px - 20.0) < 0.2 ? 2 : 1; }
  FocalPoint middle_;
  double farthest_ = 0.0;
};

TEST(AccuracyUneven, WhatPathsAloneMeetIsNotLookedUpElsewhere) {
  MetByPathsAlone field({44.0, 34.0});
  Rendering render;
  render.tile = {40, 30, 48, 38};
  render.image = {0, 0, 100, 100};
  render.half_width = 1.0;
  const TileResult result = render(field);
  EXPECT_GT(result.mean[0], 20.0f);
  EXPECT_LE(field.farthest_px(), 6.0);
}

}  // namespace
}  // namespace ifov::test::test_accuracy_uneven
