#include <gtest/gtest.h>

#include <cmath>

#include "accuracy_scenes.h"
#include "core/call_scope.h"
#include "core/error.h"
#include "core/run_control.h"

namespace ifov::test::test_accuracy_tiles {
namespace {

/// Polygons of the nearest of some points (Voronoi), six materials.
struct Clutter {
  std::vector<sampling::Point2> sites;
  double radiance[6];

  Clutter(std::uint64_t seed, double size_px, int count) {
    Draw draw(seed);
    for (int i = 0; i < count; ++i) {
      const double x = draw() * (size_px + 1.0) - 0.5;
      sites.push_back({x, draw() * (size_px + 1.0) - 0.5});
    }
    for (double& r : radiance) r = kCold + (kHot - kCold) * draw();
  }
  std::size_t site(double x, double y) const {
    std::size_t best = 0;
    double least = 1e30;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const double dx = x - sites[i].x, dy = y - sites[i].y, d = dx * dx + dy * dy;
      if (d < least) least = d, best = i;
    }
    return best;
  }
  ShapeField field() const {
    return ShapeField(
        [this](double x, double y) { return static_cast<sampling::Label>(site(x, y) % 6); },
        [this](sampling::Label l, double, double, int) { return static_cast<float>(radiance[l]); });
  }
};

/// Answers in small pieces: the sampler must not notice how its batches are cut.
class PiecewiseField final : public sampling::Field {
 public:
  explicit PiecewiseField(ShapeField& base) : base_(base) {}
  int columns() const override { return base_.columns(); }
  void labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) override {
    for (std::size_t k = points.size(); k-- > 0;) base_.labels(points.subspan(k, 1), labels.subspan(k, 1));
  }
  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override {
    const std::size_t s = static_cast<std::size_t>(stride());
    for (std::size_t k = requests.size(); k-- > 0;)
      base_.values(requests.subspan(k, 1), labels.subspan(k, 1), values.subspan(k * s, s));
  }
  std::uint32_t material_of(sampling::Label label) const override { return base_.material_of(label); }
  sampling::RayCounts counts() const override { return base_.counts(); }

 private:
  ShapeField& base_;
};

Rendering square_tile(int x0, int y0, int x1, int y1, int image) {
  Rendering r;
  r.tile = {x0, y0, x1, y1};
  r.image = {0, 0, image, image};
  r.seed = 11;
  r.half_width = 0.3 * kRadiancePerKelvin;
  return r;
}

TEST(AccuracyTiles, SameProblemSameBytesHoweverBatchesAreAnswered) {
  const Clutter clutter(1, 8.0, 80);
  ShapeField one = clutter.field(), two = clutter.field();
  PiecewiseField pieces(two);
  const Rendering render = square_tile(0, 0, 8, 8, 8);
  const sampling::TileResult a = render(one), b = render(pieces);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.half_width, b.half_width);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.abundances.size(), b.abundances.size());
}

TEST(AccuracyTiles, EveryRayIsCountedOnce) {
  const Clutter clutter(2, 12.0, 150);
  ShapeField field = clutter.field();
  const sampling::TileResult r = square_tile(4, 4, 8, 8, 12)(field);
  std::uint64_t total = r.halo_samples;
  for (std::size_t p = 0; p < r.samples.size(); ++p) {
    EXPECT_EQ(r.samples[p], r.label_rays[p] + r.radiance_evaluations[p]);
    total += r.samples[p];
  }
  EXPECT_EQ(total, field.counts().primary);
  EXPECT_GT(r.halo_samples, 0u);
}

// Small tiles and one large tile: the same picture within both intervals, and no seam along the small tiles'
// rims.
TEST(AccuracyTiles, SmallAndLargeTilesAgree) {
  const int size = 24, small = 8;
  const Clutter clutter(3, size, 600);
  ShapeField field = clutter.field();
  const sampling::TileResult whole = square_tile(0, 0, size, size, size)(field);
  int outside = 0;
  double at_rim = 0.0, inside = 0.0;
  int rim_count = 0, inside_count = 0;
  for (int ty = 0; ty < size; ty += small)
    for (int tx = 0; tx < size; tx += small) {
      const sampling::TileResult part = square_tile(tx, ty, tx + small, ty + small, size)(field);
      for (int y = 0; y < small; ++y)
        for (int x = 0; x < small; ++x) {
          const std::size_t p = static_cast<std::size_t>(y * small + x);
          const std::size_t w = static_cast<std::size_t>((ty + y) * size + tx + x);
          const double d = std::abs(part.mean[p] - whole.mean[w]);
          outside += d > part.half_width[p] + whole.half_width[w] + 1e-6;
          const bool rim = x == 0 || y == 0 || x == small - 1 || y == small - 1;
          (rim ? at_rim : inside) += part.half_width[p];
          ++(rim ? rim_count : inside_count);
        }
    }
  EXPECT_LE(outside, size * size / 100);
  EXPECT_NEAR(at_rim / rim_count, inside / inside_count, 0.1 * inside / inside_count);
}

TEST(AccuracyTiles, StopsWhenCancelled) {
  const Clutter clutter(4, 4.0, 40);
  ShapeField field = clutter.field();
  const FixedTolerance tolerance(0.01);
  const sampling::PixelFootprint footprint = sampling::PixelFootprint::box(1.0);
  const int steering_channels[1] = {0};
  CancelToken cancel;
  cancel.cancel();
  sampling::TileProblem problem;
  problem.tile = problem.image = {0, 0, 4, 4};
  problem.footprint = &footprint;
  problem.tolerance = &tolerance;
  problem.steering_channels = steering_channels;
  problem.cancel = &cancel;
  sampling::TileResult result;
  EXPECT_THROW(sampling::AccuracySampler().sample(problem, field, result), Cancelled);
}

TEST(AccuracyTiles, ACallThatIsCancelledEndsBetweenRays) {
  // The problem's own token, at which rays look, is not set.
  const Clutter clutter(4, 4.0, 40);
  CancelToken cancel;
  cancel.cancel();
  const auto sample = [&](const sampling::PixelFootprint& footprint) {
    ShapeField field = clutter.field();
    Rendering render;
    render.tile = render.image = {0, 0, 4, 4};
    render.footprint = footprint;
    render(field);
    const Call call{.inputs = {}, .cancel = &cancel};
    const CallScope scope(call);
    EXPECT_THROW(render(field), Cancelled);
  };
  sample(sampling::PixelFootprint::box(1.0));
  sample(gaussian(0.6, 2.0));
}

/// RMS error (K) and rays per source pixel under a Gaussian PSF of 0.6 px over clutter.
std::pair<double, double> psf_error(std::uint64_t seed, double limit_k, bool by_model, int* covered,
                                    int* count) {
  const int size = 12;
  const Clutter clutter(seed, size, 200);
  ShapeField field = clutter.field();
  Rendering render = square_tile(3, 3, size - 3, size - 3, size);
  render.footprint = gaussian(0.6, 2.0);
  render.half_width = limit_k * kRadiancePerKelvin;
  render.options.lattice = 2;
  render.options.footprint_by_model = by_model;
  const sampling::TileResult r = render(field);
  double squares = 0.0;
  const int n = 24;
  for (int y = 3; y < size - 3; ++y)
    for (int x = 3; x < size - 3; ++x) {
      double truth = 0.0, weight = 0.0;
      for (int j = -2 * n; j < 2 * n; ++j)
        for (int i = -2 * n; i < 2 * n; ++i) {
          const double dx = (i + 0.5) / n, dy = (j + 0.5) / n, h = render.footprint.density(dx, dy);
          truth += h * clutter.radiance[clutter.site(x + 0.5 + dx, y + 0.5 + dy) % 6];
          weight += h;
        }
      const std::size_t p = static_cast<std::size_t>((y - 3) * (size - 6) + x - 3);
      const double e = r.mean[p] - truth / weight;
      squares += e * e;
      *covered += std::abs(e) <= r.half_width[p] + 0.002 * kRadiancePerKelvin;
      ++*count;
    }
  return {std::sqrt(squares / ((size - 6) * (size - 6))) / kRadiancePerKelvin,
          static_cast<double>(field.counts().primary) / (size * size)};
}

TEST(AccuracyTiles, WeightsTheTracedModelByThePsf) {
  int covered = 0, count = 0;
  double squares = 0.0, all_rays = 0.0;
  const int scenes = 8;
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    const auto [rms, rays] = psf_error(seed, 0.25, true, &covered, &count);
    squares += rms * rms / scenes;
    all_rays += rays / scenes;
  }
  EXPECT_LE(std::sqrt(squares), 0.08);
  EXPECT_LE(all_rays, 60.1);  // some of them look for corners and gaps
  EXPECT_GE(covered, 0.93 * count);
}

// Drawing rays from each pixel's own PSF, for the same limit: the interval holds and costs many times the rays.
TEST(AccuracyTiles, DrawingRaysFromThePsfCostsMore) {
  int covered = 0, count = 0;
  const auto [rms, rays] = psf_error(3, 0.25, false, &covered, &count);
  EXPECT_LE(rms, 0.15);
  EXPECT_GE(covered, 0.9 * count);
  EXPECT_GT(rays, 3.0 * 45.0);
}

// Each pixel in clutter counts in many outputs, in each of them a little: it takes no more values than that little asks.
TEST(AccuracyTiles, CluttersValuesServeAllPixelsThatAPsfReaches) {
  const int size = 12;
  const Clutter clutter(5, size, 60 * size * size);
  const auto rays = [&](const sampling::PixelFootprint& footprint) {
    ShapeField field = clutter.field();
    Rendering render = square_tile(3, 3, size - 3, size - 3, size);
    render.footprint = footprint;
    render.half_width = 0.6 * kRadiancePerKelvin;
    const sampling::TileResult r = render(field);
    EXPECT_GT(static_cast<double>(r.converged_count()), 0.9 * static_cast<double>(r.reasons.size()));
    return static_cast<double>(field.counts().primary);
  };
  const double box = rays(sampling::PixelFootprint::box(1.0)) / 36.0, wide = rays(gaussian(0.6, 2.0)) / 100.0;
  EXPECT_LT(wide, 0.6 * box);
}

// A gradient under a box narrower than the pixel: only the box's own part counts.
TEST(AccuracyTiles, FillFactorWeighsTheSensitivePartAlone) {
  ShapeField field([](double x, double) { return static_cast<sampling::Label>(x > 1.6); },
                   [](sampling::Label l, double, double, int) { return l != 0 ? 3.0f : 1.0f; });
  Rendering render = three_by_three(1);
  render.half_width = 0.01;
  render.footprint = sampling::PixelFootprint::box(0.5);
  const sampling::TileResult r = render(field);
  EXPECT_NEAR(r.mean[4], 1.0 + 2.0 * (1.75 - 1.6) / 0.5, 0.012);
  EXPECT_NEAR(r.mean[3], 1.0, 1e-6);
  EXPECT_NEAR(r.mean[5], 3.0, 1e-6);
}

TEST(AccuracyTiles, RefusesWhatItCannotWorkWith) {
  sampling::AccuracyOptions none;
  none.lattice = 0;
  EXPECT_THROW(sampling::AccuracySampler{none}, std::invalid_argument);
  ShapeField field = disc_field(1, 1, 0.5);
  sampling::TileResult result;
  EXPECT_THROW(sampling::AccuracySampler().sample({}, field, result), std::invalid_argument);
}

}  // namespace
}  // namespace ifov::test::test_accuracy_tiles
