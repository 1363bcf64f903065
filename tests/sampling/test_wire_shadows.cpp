// Shadows of wires that hide a part of the Sun, wherever one stands: few paths from there are in the dark, and three points of the
// Sun's rim, by which labels go, tell of three lines of the shadow alone. Against the areas of strips of a disc.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "accuracy_scenes.h"
#include "faulty_samplers.h"
#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/weights/block_sums.h"
#include "sampling/random.h"

namespace ifov::test::test_wire_shadows {
namespace {

using namespace sampling;

class WireShadow final : public Field {
 public:
  /// Half the wire's width, and the radius of the Sun's image of which it makes the shadow, px.
  WireShadow(double begin_px, double slope, double half_px, double sun_px)
      : begin_px_(begin_px), slope_(slope), half_px_(half_px), sun_px_(sun_px) {}

  int columns() const override { return 1; }
  void labels(std::span<const FocalPoint> points, std::span<Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) labels[k] = label(points[k]);
  }
  void values(std::span<const PathRequest> requests, std::span<Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const PathRequest& r = requests[k];
      labels[k] = label(r.point);
      const std::uint64_t key = hash(r.sequence, r.index);
      const double place =
          std::sqrt(unit_double(hash(key, 1))) * std::cos(2.0 * M_PI * unit_double(hash(key, 2)));
      values[k * static_cast<std::size_t>(stride())] = hides(r.point, place) ? kDark : kLit;
    }
  }
  bool values_in_shadow(std::span<const PathRequest> requests, std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) values[k * static_cast<std::size_t>(stride())] = kDark;
    return true;
  }
  std::uint32_t material_of(Label) const override { return 0; }
  bool uneven(Label label) const override { return label == 2; }
  RayCounts counts() const override { return {}; }

  /// Where pilot rays by way of the wire arrive.
  std::vector<FocalPoint> pilots(int side) const {
    std::vector<FocalPoint> points;
    for (double x = 0.1; x < side; x += 0.35)
      for (const double place : kPlaces) {
        const FocalPoint p{x, begin_px_ + slope_ * x + place * sun_px_ * std::hypot(1.0, slope_)};
        if (p.y_px >= 0.0 && p.y_px < side) points.push_back(p);
      }
    return points;
  }
  /// Places all over its shadow, and what is hidden there at most.
  std::vector<ThinShadow> places(int side) const {
    std::vector<ThinShadow> places;
    const double share = 4.0 / M_PI * half_px_ / sun_px_;
    for (double x = 0.1; x < side; x += 0.35)
      for (double place = -0.95; place < 1.0; place += 0.19) {
        const FocalPoint p{x, begin_px_ + slope_ * x + place * sun_px_ * std::hypot(1.0, slope_)};
        if (p.y_px >= 0.0 && p.y_px < side) places.push_back({p, static_cast<float>(share)});
      }
    return places;
  }
  /// Mean over pixel (i, j).
  double mean(int i, int j) const {
    // Most pixels lie wholly beside the shadow, by more than half of their diagonal.
    if (std::abs(across({i + 0.5, j + 0.5})) > half_px_ + sun_px_ + 0.71) return kLit;
    constexpr int kAlong = 60, kAcross = 400;
    const auto area = [](double s) {
      s = std::clamp(s, -1.0, 1.0);
      return (s * std::sqrt(1.0 - s * s) + std::asin(s)) / M_PI;
    };
    double sum = 0.0;
    for (int b = 0; b < kAcross; ++b)
      for (int a = 0; a < kAlong; ++a) {
        const double u = across({i + (a + 0.5) / kAlong, j + (b + 0.5) / kAcross});
        sum += area((u + half_px_) / sun_px_) - area((u - half_px_) / sun_px_);
      }
    return kLit - (kLit - kDark) * sum / (kAlong * kAcross);
  }
  static constexpr float kLit = 100.0f, kDark = 10.0f;

 private:
  static constexpr double kPlaces[3] = {-0.87, 0.1, 0.77};  // of points of the rim
  double across(FocalPoint p) const {
    return (p.y_px - slope_ * p.x_px - begin_px_) / std::hypot(1.0, slope_);
  }
  bool hides(FocalPoint p, double place) const { return std::abs(across(p) - sun_px_ * place) < half_px_; }
  Label label(FocalPoint p) const {
    return std::any_of(std::begin(kPlaces), std::end(kPlaces), [&](double at) { return hides(p, at); }) ? 2
                                                                                                        : 1;
  }
  double begin_px_, slope_, half_px_, sun_px_;
};

struct Judged {
  int pixels = 0, converged = 0, off = 0, far_off = 0;

  /// Those pixels of an image that lie in the shadow by more than this.
  void add(const TileResult& image, const WireShadow& field, int side, double darker) {
    for (int p = 0; p < side * side; ++p) {
      const auto at = static_cast<std::size_t>(p);
      const double truth = field.mean(p % side, p / side);
      if (truth > WireShadow::kLit - darker) continue;
      ++pixels;
      if (!image.converged(at)) continue;
      ++converged;
      const double error = std::abs(static_cast<double>(image.mean[at]) - truth),
                   half = static_cast<double>(image.half_width[at]);
      off += error > half;
      far_off += error > 3.0 * half;
    }
  }
};

Judged judge(const PixelSampler& sampler) {
  constexpr int kSide = 8;
  Judged sum;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const WireShadow made(2.0 + 4.0 * unit_double(hash(seed, 1)), -1.0 + 2.0 * unit_double(hash(seed, 2)),
                          0.02 + 0.03 * unit_double(hash(seed, 3)), 0.2 + 0.3 * unit_double(hash(seed, 4)));
    WireShadow field = made;
    const std::vector<FocalPoint> pilots = field.pilots(kSide);
    const std::vector<std::uint32_t> objects(pilots.size(), Field::kNoObject);
    const TileResult result = sampled_at_a_percent(field, kSide, seed, sampler, pilots, objects);
    sum.add(result, field, kSide, 1.0);
  }
  return sum;
}

TEST(WireShadows, AreRight) {
  const Judged sum = judge(AccuracySampler());
  EXPECT_GT(sum.pixels, 1400);
  EXPECT_GT(sum.converged, 0.98 * sum.pixels);
  EXPECT_LT(sum.off, 0.055 * sum.converged);
  EXPECT_LT(sum.far_off, 0.009 * sum.converged);
}

TEST(WireShadows, PlantedFaultAPenumbraIsItsMean) {
  const Judged sum = judge(SamplerOf<PenumbraeAreMeans>());
  EXPECT_GT(sum.off, 0.08 * sum.converged);
  EXPECT_GT(sum.far_off, 0.03 * sum.converged);
}

/// Of wires that hide 0.3 to 5 parts in a hundred of the Sun, at most; pixels that differ by 0.3 of what was asked for.
Judged judge_thin(bool told) {
  constexpr int kSide = 8;
  Judged sum;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const double sun_px = 0.3 + 0.9 * unit_double(hash(seed, 4)),
                 half_px = sun_px * 0.0025 * std::pow(16.0, unit_double(hash(seed, 3)));
    WireShadow field(2.0 + 4.0 * unit_double(hash(seed, 1)), -1.0 + 2.0 * unit_double(hash(seed, 2)), half_px,
                     sun_px);
    const std::vector<FocalPoint> pilots = field.pilots(kSide);
    const std::vector<std::uint32_t> objects(pilots.size(), Field::kNoObject);
    const std::vector<ThinShadow> places = field.places(kSide);
    const TileResult result =
        sampled_at_a_percent(field, kSide, seed, AccuracySampler(), pilots, objects,
                             told ? std::span<const ThinShadow>(places) : std::span<const ThinShadow>());
    sum.add(result, field, kSide, 0.3);
  }
  return sum;
}

TEST(WireShadows, TooThinForTheRimAreRight) {
  const Judged sum = judge_thin(true);
  EXPECT_GT(sum.pixels, 1500);
  EXPECT_GT(sum.converged, 0.98 * sum.pixels);
  EXPECT_LT(sum.off, 0.055 * sum.converged);
  EXPECT_LT(sum.far_off, 0.003 * sum.converged);
}

TEST(WireShadows, PlantedFaultNobodyTellsOfThinOnes) {
  const Judged sum = judge_thin(false);
  EXPECT_GT(sum.off, 0.11 * sum.converged);
  EXPECT_GT(sum.far_off, 0.03 * sum.converged);
}

// Of noise each tells of its variance.
TEST(WireShadows, ValuesOutsideBlocksTellTheVariance) {
  constexpr int kBlocks = 20000;
  BlockSums sums(1);
  double others = 0.0;
  for (std::uint64_t b = 0; b < kBlocks; ++b) {
    float values[3];
    const float* rows[3];
    for (std::uint64_t k = 0; k < 3; ++k) {
      values[k] = static_cast<float>(std::sqrt(12.0) * unit_double(hash(b, k)));
      rows[k] = &values[k];
    }
    sums.add_block({rows, b % 2 == 0 ? std::size_t{3} : std::size_t{2}});
    others += b % 2 == 0;
  }
  EXPECT_EQ(sums.alone(), others);
  EXPECT_NEAR(sums.squares_alone(0) / sums.alone(), 1.0, 0.05);
  BlockSums single(1);
  for (std::uint64_t b = 0; b < 12; ++b) {
    const float value = b == 5 ? 10.0f : 100.0f;
    const float* row = &value;
    single.add_block({&row, 1});
  }
  EXPECT_EQ(single.squares(0), 0.0);
  EXPECT_GT(single.squares_alone(0), 0.3 * 90.0 * 90.0);
}

/// What a stratum of even ground is said to vary by, whose values are 100 but for `dark` ones of 10, `alone` of which stand alone in blocks.
template <class Estimates>
double variance_of_mean(int blocks, int in_a_row, int alone) {
  const Lattice lattice({0, 0, 4, 4}, 3);
  LatticeValues at;
  at.columns = 1;
  const std::size_t vertices = static_cast<std::size_t>((lattice.columns() + 1) * (lattice.rows() + 1));
  at.labels.assign(vertices, 0);
  at.values.assign(vertices, 100.0f);
  at.values[5] = 99.99f;
  at.constant = {0};
  LabelTable table(1);
  table.index(Label{7});
  for (const float& value : at.values) table.add(0, &value);
  const LabelSpread spread(lattice, table, at);
  BlockSums round(1);
  const float lit = 100.0f, dark = 10.0f;
  for (int b = 0; b < blocks; ++b) {
    const bool row = b == 1;
    const float* const rows[4] = {row && in_a_row > 0 ? &dark : &lit, row && in_a_row > 1 ? &dark : &lit,
                                  &lit, &lit};
    round.add_block({rows, 4});
  }
  for (int k = 0; k < alone; ++k) {
    const float* const row = k == 0 ? &dark : &lit;
    round.add_block({&row, 1});
  }
  SourcePixel pixel;
  Stratum stratum;
  stratum.label = 0;
  stratum.rounds.push_back(round);
  pixel.strata.push_back(stratum);
  StratumMoments moments;
  const int columns[] = {0};
  Estimates(lattice, at, table, spread).moments(pixel, 0, columns, moments);
  return moments.variance[0] * moments.share;
}

// One of 13, and two of 16, of two values: p (1 - p) / (n - 1) times the square of the difference, whatever the blocks are; an estimate
// of three degrees of freedom that is told by half of it is within a factor of 3.
TEST(WireShadows, AFarValueCountsWhereverItStands) {
  const double one = 90.0 * 90.0 / 13.0 * 12.0 / 13.0 / 12.0, two = 90.0 * 90.0 / 8.0 * 7.0 / 8.0 / 15.0;
  EXPECT_GT(variance_of_mean<StratumEstimates>(3, 0, 1), one / 3.0);
  EXPECT_LT(variance_of_mean<StratumEstimates>(3, 0, 1), 3.0 * one);
  EXPECT_GT(variance_of_mean<StratumEstimates>(4, 2, 0), two / 3.0);
  EXPECT_LT(variance_of_mean<StratumEstimates>(4, 2, 0), 3.0 * two);
  EXPECT_GT(variance_of_mean<StratumEstimates>(4, 1, 0), 90.0 * 90.0 / 16.0 / 16.0 / 3.0);
  EXPECT_LT(variance_of_mean<StratumEstimates>(4, 0, 0), 1e-3);
}

TEST(WireShadows, PlantedFaultBlocksAloneTell) {
  EXPECT_LT(variance_of_mean<AloneUntold>(3, 0, 1), 1.0);
  EXPECT_LT(variance_of_mean<AloneUntold>(4, 2, 0), 1.0);
}

}  // namespace
}  // namespace ifov::test::test_wire_shadows
