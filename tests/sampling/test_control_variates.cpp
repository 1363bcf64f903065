// Means of what maps tell take no rays, and what they tell wrongly costs rays alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "accuracy_scenes.h"
#include "faulty_samplers.h"
#include "sampling/accuracy/basis/mapped_surface.h"
#include "sampling/accuracy/radiance/control_variates.h"

namespace ifov::test::test_control_variates {
namespace {

using namespace sampling;

constexpr int kSide = 6;
constexpr double kTexel_px = 0.25, kOffset_px = 0.1, kBorder_px = 2.37, kNoise = 0.3, kHalfWidth = 0.04;

std::int64_t texel(double px) { return static_cast<std::int64_t>(std::floor((px + kOffset_px) / kTexel_px)); }
double random_of_texel(int what, std::int64_t i, std::int64_t j) { return unit_double(hash(17, what, i, j)); }

/// A rough raster of square texels under light with noise of its own, and what its maps say of it.
struct Raster {
  double noise = 0.3;
  double parts_px = 0.0;  // side of the squares of one label each; 0: two labels, left and right of a border
  bool maps = true;       // whether they are told
  double shift_px = 0.0;  // as if they lay so much farther left
  bool fitted_exactly = false;  // planted fault: by as many coefficients as the lattice has values
};

Label label_at(const Raster& raster, double x, double y) {
  if (raster.parts_px == 0.0) return x < kBorder_px ? 1 : 2;
  const auto part = [&](double px) { return static_cast<Label>(std::floor((px + 1.0) / raster.parts_px)); };
  return 1 + 64 * part(y) + part(x);
}
/// What it gives off, and a reflectance.
double own_of(Label label, std::int64_t i, std::int64_t j) {
  return (label == 1 ? 5.0 : 9.0) + 3.0 * random_of_texel(static_cast<int>(label), i, j);
}
double reflectance_of(Label label, std::int64_t i, std::int64_t j) {
  return label == 1 ? 0.3 : 0.1 + 0.6 * random_of_texel(7, i, j);
}
double light_at(double x) { return 4.0 * (1.0 + 0.04 * x); }

/// Where a pixel's texels and labels end along one axis.
std::vector<double> edges_of_pixel(const Raster& raster, int pixel) {
  std::vector<double> edges{1.0 * pixel, pixel + 1.0, raster.parts_px == 0.0 ? kBorder_px : 1.0 * pixel};
  for (std::int64_t i = texel(pixel); i <= texel(pixel + 1); ++i)
    edges.push_back(static_cast<double>(i) * kTexel_px - kOffset_px);
  for (int part = 0; raster.parts_px > 0.0 && part * raster.parts_px < kSide + 2.0; ++part)
    edges.push_back(part * raster.parts_px - 1.0);
  for (double& edge : edges) edge = std::clamp(edge, 1.0 * pixel, pixel + 1.0);
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Part by part: light is linear in x, so that its mean over a part of a texel is that in the middle of the part.
double mean_of_pixel(const Raster& raster, int px, int py) {
  const std::vector<double> xs = edges_of_pixel(raster, px), ys = edges_of_pixel(raster, py);
  double sum = 0.0;
  for (std::size_t a = 1; a < xs.size(); ++a)
    for (std::size_t b = 1; b < ys.size(); ++b) {
      const double x = 0.5 * (xs[a - 1] + xs[a]), y = 0.5 * (ys[b - 1] + ys[b]);
      const Label label = label_at(raster, x, y);
      const std::int64_t i = texel(x), j = texel(y);
      sum += (xs[a] - xs[a - 1]) * (ys[b] - ys[b - 1]) *
             (own_of(label, i, j) + light_at(x) * reflectance_of(label, i, j));
    }
  return sum;
}

/// The same as a footprint weighs it, which is even enough over a sixteenth of a texel.
double weighed_mean(const Raster& raster, int px, int py, const PixelFootprint& footprint) {
  constexpr int kParts = 4;
  const double reach = footprint.half_width_px(), cx = px + 0.5, cy = py + 0.5;
  const auto edges = [&](double centre) {
    std::vector<double> all{centre - reach, centre + reach};
    for (const double edge : {kBorder_px})
      if (raster.parts_px == 0.0 && centre == cx) all.push_back(edge);
    for (std::int64_t i = texel(centre - reach); i <= texel(centre + reach) + 1; ++i)
      for (int part = 0; part < kParts; ++part)
        all.push_back((static_cast<double>(i) + static_cast<double>(part) / kParts) * kTexel_px - kOffset_px);
    for (double& edge : all) edge = std::clamp(edge, centre - reach, centre + reach);
    std::sort(all.begin(), all.end());
    return all;
  };
  const std::vector<double> xs = edges(cx), ys = edges(cy);
  double sum = 0.0;
  for (std::size_t a = 1; a < xs.size(); ++a)
    for (std::size_t b = 1; b < ys.size(); ++b) {
      const double x = 0.5 * (xs[a - 1] + xs[a]), y = 0.5 * (ys[b - 1] + ys[b]);
      const Label label = label_at(raster, x, y);
      const std::int64_t i = texel(x), j = texel(y);
      sum += footprint.integral(xs[a - 1] - cx, ys[b - 1] - cy, xs[a] - cx, ys[b] - cy) *
             (own_of(label, i, j) + light_at(x) * reflectance_of(label, i, j));
    }
  return sum;
}

class MappedField final : public Field {
 public:
  explicit MappedField(const Raster& raster) : raster_(raster) {}
  int columns() const override { return 1; }
  void labels(std::span<const FocalPoint> points, std::span<Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k)
      labels[k] = label_at(raster_, points[k].x_px, points[k].y_px);
    counts_.primary += points.size();
  }
  void values(std::span<const PathRequest> requests, std::span<Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const FocalPoint at = requests[k].point;
      labels[k] = label_at(raster_, at.x_px, at.y_px);
      const std::int64_t i = texel(at.x_px), j = texel(at.y_px);
      const double noise =
          raster_.noise * (2.0 * unit_double(hash(requests[k].sequence, requests[k].index)) - 1.0);
      const double reflectance = reflectance_of(labels[k], i, j);
      values[k * static_cast<std::size_t>(stride())] =
          static_cast<float>(own_of(labels[k], i, j) + (light_at(at.x_px) + noise) * reflectance);
      if (raster_.fitted_exactly && !told_) seen_[{at.x_px, at.y_px}] = noise * reflectance;
    }
    counts_.primary += requests.size();
  }
  std::unique_ptr<MappedSurface> mapped_surface(Label label, const FocalPoint&) override {
    if (!raster_.maps) return nullptr;
    told_ = true;
    return std::make_unique<Surface>(*this, label);
  }
  std::uint32_t material_of(Label label) const override { return static_cast<std::uint32_t>(label); }
  RayCounts counts() const override { return counts_; }

 private:
  struct Surface final : MappedSurface {
    Surface(const MappedField& field, Label label) : field_(field), label_(label) {}
    void look_up(std::span<const FocalPoint> points, std::span<float> own,
                 std::span<float> reflectance) const override {
      const auto stride = static_cast<std::size_t>(field_.stride());
      for (std::size_t k = 0; k < points.size(); ++k) {
        const FocalPoint at = points[k];
        const std::int64_t i = texel(at.x_px + field_.raster_.shift_px), j = texel(at.y_px);
        const auto seen = field_.seen_.find({at.x_px, at.y_px});
        own[k * stride] =
            static_cast<float>(own_of(label_, i, j) + (seen != field_.seen_.end() ? seen->second : 0.0));
        reflectance[k * stride] = static_cast<float>(reflectance_of(label_, i, j));
      }
    }
    const MappedField& field_;
    Label label_;
  };
  Raster raster_;
  bool told_ = false;
  std::map<std::pair<double, double>, double> seen_;  // the noise in values of the lattice
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

/// `footprint` null: the pixel itself.
template <class Sampler>
Found render(const Raster& raster, int seeds, const PixelFootprint* footprint = nullptr) {
  Found found;
  for (int seed = 0; seed < seeds; ++seed) {
    MappedField field(raster);
    Rendering render = three_by_three(static_cast<std::uint64_t>(seed));
    render.tile = render.image = {0, 0, kSide, kSide};
    render.half_width = kHalfWidth;
    if (footprint != nullptr) render.footprint = *footprint;
    render.sampler = make_sampler<Sampler>;
    const TileResult result = render(field);
    found.rays += static_cast<double>(field.counts().primary);
    for (int p = 0; p < kSide * kSide; ++p) {
      const int x = p % kSide, y = p / kSide;
      const double truth =
          footprint == nullptr ? mean_of_pixel(raster, x, y) : weighed_mean(raster, x, y, *footprint);
      const double error = static_cast<double>(result.mean[p]) - truth;
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
  const Found told = render<AccuracySampler>({}, 25), drawn = render<AccuracySampler>({.maps = false}, 2);
  EXPECT_GE(told.held, 0.94);
  EXPECT_LE(told.half_width, kHalfWidth * 1.0001);
  EXPECT_EQ(told.unconverged, 0.0);
  EXPECT_LT(told.half_width / told.rms, 3.0);
  EXPECT_LT(told.rays, 0.15 * drawn.rays);
  EXPECT_GE(drawn.held, 0.94);
}

TEST(ControlVariates, OfMapsThatAreWrongCostRaysAlone) {
  // A sixteenth of a texel off: still of use. Half of one: hardly.
  const Found near = render<AccuracySampler>({.shift_px = kTexel_px / 16.0}, 8),
              far = render<AccuracySampler>({.shift_px = kTexel_px / 2.0}, 4);
  EXPECT_GE(near.held, 0.94);
  EXPECT_GE(far.held, 0.94);
  const Found told = render<AccuracySampler>({}, 4);
  EXPECT_GT(near.rays, told.rays);
  EXPECT_GT(far.rays, near.rays);
}

TEST(ControlVariates, OverTheRegionBesideAreNoticed) {
  const Found off = render<SamplerOf<HalfATexelOff>>({}, 6);
  EXPECT_LT(off.held, 0.5);
}

TEST(ControlVariates, AreWeighedByAFootprint) {
  for (const double sigma_px : {0.3, 0.6}) {
    const PixelFootprint footprint = gaussian(sigma_px, 2.0);
    const Found told = render<AccuracySampler>({}, 24, &footprint),
                drawn = render<AccuracySampler>({.maps = false}, 1, &footprint),
                off = render<SamplerOf<HalfATexelOff>>({}, 2, &footprint);
    EXPECT_GE(told.held, 0.94) << sigma_px;
    EXPECT_LE(told.half_width, kHalfWidth * 1.0001) << sigma_px;
    EXPECT_EQ(told.unconverged, 0.0) << sigma_px;
    EXPECT_LT(told.half_width / told.rms, 3.5) << sigma_px;
    EXPECT_LT(told.rays, 0.2 * drawn.rays) << sigma_px;
    EXPECT_GE(drawn.held, 0.94) << sigma_px;
    EXPECT_LT(off.held, 0.85) << sigma_px;
  }
}

TEST(ControlVariates, OfLabelsWithFewVerticesHold) {
  // 3 to 16 vertices and more a label: little to fit them to, and little that tells what is left.
  for (const double parts_px : {0.6, 0.9, 1.7}) {
    const Found found = render<AccuracySampler>({.parts_px = parts_px}, 6);
    EXPECT_GE(found.held, 0.95) << parts_px;
    EXPECT_LE(found.half_width, kHalfWidth * 1.0001) << parts_px;
  }
}

TEST(ControlVariates, OfSeveralLabelsLeaveTheLimitWithinReach) {
  const Found found = render<AccuracySampler>({.noise = 0.6, .parts_px = 0.9}, 12);
  EXPECT_GE(found.held, 0.95);
  EXPECT_EQ(found.unconverged, 0.0);
}

TEST(ControlVariates, MustNotTakeTheVarianceTheyAreJudgedBy) {
  const Found right = render<AccuracySampler>({.noise = 0.6}, 20),
              fault = render<SamplerOf<NothingBesideTells>>({.noise = 0.6, .fitted_exactly = true}, 20);
  EXPECT_GE(right.held, 0.96);
  EXPECT_LT(fault.held, 0.93);
}

}  // namespace
}  // namespace ifov::test::test_control_variates
