// Means of what maps tell take no rays, and what they tell wrongly costs rays alone.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "accuracy_scenes.h"
#include "faulty_samplers.h"
#include "sampling/accuracy/basis/mapped_surface.h"
#include "sampling/accuracy/radiance/control_variates.h"

namespace ifov::test {
namespace {

using namespace sampling;

constexpr int kSide = 6;
constexpr double kTexel_px = 0.25, kOffset_px = 0.1, kBorder_px = 2.37, kNoise = 0.3, kHalfWidth = 0.04;

std::int64_t texel(double px) { return static_cast<std::int64_t>(std::floor((px + kOffset_px) / kTexel_px)); }
double random_of_texel(int what, std::int64_t i, std::int64_t j) { return unit_double(hash(17, what, i, j)); }
Label label_at(double x) { return x < kBorder_px ? 1 : 2; }

/// A rough raster of square texels: what it gives off, and a reflectance.
double own_of(Label label, std::int64_t i, std::int64_t j) {
  return (label == 1 ? 5.0 : 9.0) + 3.0 * random_of_texel(static_cast<int>(label), i, j);
}
double reflectance_of(Label label, std::int64_t i, std::int64_t j) {
  return label == 1 ? 0.3 : 0.1 + 0.6 * random_of_texel(7, i, j);
}
double light_at(double x) { return 4.0 * (1.0 + 0.04 * x); }

/// Texel by texel: light is linear in x, so that its mean over a part of a texel is that in the middle of the part.
double mean_of_pixel(int px, int py) {
  double sum = 0.0;
  for (std::int64_t i = texel(px) - 1; i <= texel(px + 1); ++i)
    for (std::int64_t j = texel(py) - 1; j <= texel(py + 1); ++j)
      for (const Label label : {1, 2}) {
        const auto edge = [](std::int64_t k) { return static_cast<double>(k) * kTexel_px - kOffset_px; };
        const double x0 = std::max({edge(i), 1.0 * px, label == 1 ? -1e9 : kBorder_px}),
                     x1 = std::min({edge(i + 1), px + 1.0, label == 1 ? kBorder_px : 1e9}),
                     y0 = std::max(edge(j), 1.0 * py), y1 = std::min(edge(j + 1), py + 1.0);
        if (x1 <= x0 || y1 <= y0) continue;
        sum += (x1 - x0) * (y1 - y0) *
               (own_of(label, i, j) + light_at(0.5 * (x0 + x1)) * reflectance_of(label, i, j));
      }
  return sum;
}

/// The raster under light with noise of its own. Its maps may be told as if they lay `shift_px` farther left, or not at all.
class MappedField final : public Field {
 public:
  explicit MappedField(bool maps, double shift_px = 0.0) : maps_(maps), shift_(shift_px) {}
  int columns() const override { return 1; }
  void labels(std::span<const FocalPoint> points, std::span<Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) labels[k] = label_at(points[k].x_px);
    counts_.primary += points.size();
  }
  void values(std::span<const PathRequest> requests, std::span<Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const FocalPoint at = requests[k].point;
      labels[k] = label_at(at.x_px);
      const std::int64_t i = texel(at.x_px), j = texel(at.y_px);
      const double noise = kNoise * (2.0 * unit_double(hash(requests[k].sequence, requests[k].index)) - 1.0);
      values[k * static_cast<std::size_t>(stride())] = static_cast<float>(
          own_of(labels[k], i, j) + (light_at(at.x_px) + noise) * reflectance_of(labels[k], i, j));
    }
    counts_.primary += requests.size();
  }
  std::unique_ptr<MappedSurface> mapped_surface(Label label, const FocalPoint&) override {
    if (!maps_) return nullptr;
    return std::make_unique<Surface>(label, shift_, static_cast<std::size_t>(stride()));
  }
  std::uint32_t material_of(Label label) const override { return static_cast<std::uint32_t>(label); }
  RayCounts counts() const override { return counts_; }

 private:
  struct Surface final : MappedSurface {
    Surface(Label label, double shift, std::size_t stride) : label_(label), shift_(shift), stride_(stride) {}
    void look_up(std::span<const FocalPoint> points, std::span<float> own,
                 std::span<float> reflectance) const override {
      for (std::size_t k = 0; k < points.size(); ++k) {
        const std::int64_t i = texel(points[k].x_px + shift_), j = texel(points[k].y_px);
        own[k * stride_] = static_cast<float>(own_of(label_, i, j));
        reflectance[k * stride_] = static_cast<float>(reflectance_of(label_, i, j));
      }
    }
    Label label_;
    double shift_;
    std::size_t stride_;
  };
  bool maps_;
  double shift_;
  RayCounts counts_;
};

/// Means of what is foretold are taken over the region beside a stratum, half a texel farther left.
class HalfATexelOff final : public AccuracyParts {
 public:
  std::unique_ptr<ControlVariates> controls(Field& field, const Lattice& lattice, const LabelTable& table,
                                            std::uint64_t seed) const override {
    return std::make_unique<Off>(field, lattice, table, seed);
  }

 private:
  struct Off final : ControlVariates {
    using ControlVariates::ControlVariates;
    FocalPoint place(const FocalPoint& point) const override {
      return {point.x_px - 0.5 * kTexel_px, point.y_px};
    }
  };
};

struct Found {
  double held = 0.0, rms = 0.0, half_width = 0.0, rays = 0.0, unconverged = 0.0;
};

template <class Sampler>
Found render(bool maps, double shift_px, int seeds) {
  Found found;
  for (int seed = 0; seed < seeds; ++seed) {
    MappedField field(maps, shift_px);
    Rendering render = three_by_three(static_cast<std::uint64_t>(seed));
    render.tile = render.image = {0, 0, kSide, kSide};
    render.half_width = kHalfWidth;
    render.sampler = make_sampler<Sampler>;
    const TileResult result = render(field);
    found.rays += static_cast<double>(field.counts().primary);
    for (int p = 0; p < kSide * kSide; ++p) {
      const double error = static_cast<double>(result.mean[p]) - mean_of_pixel(p % kSide, p / kSide);
      found.held += std::abs(error) <= static_cast<double>(result.half_width[p]);
      found.rms += error * error;
      found.half_width += static_cast<double>(result.half_width[p]);
      found.unconverged += result.reasons[p] != 0;
    }
  }
  const double pixels = static_cast<double>(seeds) * kSide * kSide;
  for (double* sum : {&found.held, &found.rms, &found.half_width, &found.rays, &found.unconverged})
    *sum /= pixels;
  found.rms = std::sqrt(found.rms);
  return found;
}

TEST(ControlVariates, TakeTheMeanOfARasterFromItsTexels) {
  const Found told = render<AccuracySampler>(true, 0.0, 25), drawn = render<AccuracySampler>(false, 0.0, 2);
  EXPECT_GE(told.held, 0.94);
  EXPECT_LE(told.half_width, kHalfWidth * 1.0001);
  EXPECT_EQ(told.unconverged, 0.0);
  EXPECT_LT(told.half_width / told.rms, 3.0);
  EXPECT_LT(told.rays, 0.15 * drawn.rays);
  EXPECT_GE(drawn.held, 0.94);
}

TEST(ControlVariates, OfMapsThatAreWrongCostRaysAlone) {
  // A sixteenth of a texel off: still of use. Half of one: hardly.
  const Found near = render<AccuracySampler>(true, kTexel_px / 16.0, 8),
              far = render<AccuracySampler>(true, kTexel_px / 2.0, 4);
  EXPECT_GE(near.held, 0.94);
  EXPECT_GE(far.held, 0.94);
  const Found told = render<AccuracySampler>(true, 0.0, 4);
  EXPECT_GT(near.rays, told.rays);
  EXPECT_GT(far.rays, near.rays);
}

TEST(ControlVariates, OverTheRegionBesideAreNoticed) {
  const Found off = render<SamplerOf<HalfATexelOff>>(true, 0.0, 6);
  EXPECT_LT(off.held, 0.5);
}

}  // namespace
}  // namespace ifov::test
