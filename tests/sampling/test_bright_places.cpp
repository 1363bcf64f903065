// Places that outshine an image and are smaller than a pixel: what is drawn of them, and images as a whole that hold them.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "image_scenes.h"
#include "sampling/footprint_groups.h"
#include "sampling/image/bright_places.h"
#include "sampling/image/image_plan.h"
#include "sampling/image/image_sampler.h"
#include "sampling/image/survey.h"
#include "sampling/pixel_footprint.h"
#include "sampling/random.h"
#include "sampling/tile.h"

namespace ifov::sampling::test_bright_places {
namespace {

using Rectangle = BrightPlaces::Rectangle;

double gaussian(double x, double sigma) {
  return std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2.0 * std::numbers::pi));
}

PixelFootprint gaussian_footprint() {
  constexpr int kCells = 256;
  constexpr double kHalf = 2.0, kSigma = 0.5;
  std::vector<double> across;
  for (int k = 0; k < kCells; ++k)
    across.push_back(gaussian((k + 0.5) * 2.0 * kHalf / kCells - kHalf, kSigma));
  return PixelFootprint::product(kHalf, 2.0 * kHalf / kCells, across, across);
}

bool overlap(const Rectangle& a, const Rectangle& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

TEST(BrightPlaces, HoldAllOfTheirBoxesAndDoNotOverlap) {
  std::vector<BrightPlaces::Box> boxes;
  for (std::uint64_t k = 0; k < 60; ++k) {
    const auto random = [k](std::uint64_t n) { return unit_double(hash(7, k, n)); };
    BrightPlaces::Box box{{6.0 * random(0) - 1.0, 6.0 * random(1) - 1.0}, 0.3 * random(2), 0.3 * random(3)};
    if (k % 3 == 0) box.brightest = box.centre;
    boxes.push_back(box);
  }
  const BrightPlaces places(boxes);
  std::vector<Rectangle> all;
  places.visit_pixels([&](int i, int j) {
    for (const Rectangle& r : places.in(i, j)) {
      EXPECT_TRUE(r.x0 >= i && r.x1 <= i + 1 && r.y0 >= j && r.y1 <= j + 1);
      all.push_back(r);
    }
  });
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(overlap(all[a], all[b]));
  for (const BrightPlaces::Box& box : boxes)
    for (std::uint64_t k = 0; k < 40; ++k) {
      const FocalPoint point{box.centre.x_px + box.half_width_px * (2.0 * unit_double(hash(k, 1)) - 1.0),
                             box.centre.y_px + box.half_height_px * (2.0 * unit_double(hash(k, 2)) - 1.0)};
      int holding = 0;
      for (const Rectangle& r : all) holding += r.holds(point);
      EXPECT_EQ(holding, 1);
    }
  // About a place that is known to shine they are as small as what may be there.
  const FocalPoint known = boxes[0].centre;
  for (const Rectangle& r : all)
    if (r.holds(known)) {
      EXPECT_LE(r.x1 - r.x0, 1.0 / 256.0);
    }
}

TEST(BrightPlaces, PointsLieInThemAsDenselyAsTheFootprintHasIt) {
  const PixelFootprint footprint = gaussian_footprint();
  // Beside the middle, where the density falls to a third within the rectangle.
  const Rectangle where{4.7, 2.2, 4.95, 2.45};
  const BrightWarp warp(footprint, where, 4, 2);
  constexpr int kSide = 256, kFine = 400;
  double x = 0.0, squares = 0.0;
  for (int b = 0; b < kSide; ++b)
    for (int a = 0; a < kSide; ++a) {
      const FocalPoint p = warp.at({(a + 0.5) / kSide, (b + 0.5) / kSide}, hash(a, b));
      ASSERT_TRUE(where.holds(p));
      x += p.x_px / (kSide * kSide);
      squares += p.x_px * p.y_px / (kSide * kSide);
    }
  double true_x = 0.0, true_squares = 0.0, weight = 0.0, even_x = 0.0;
  for (int b = 0; b < kFine; ++b)
    for (int a = 0; a < kFine; ++a) {
      const double px = where.x0 + 0.25 * (a + 0.5) / kFine, py = where.y0 + 0.25 * (b + 0.5) / kFine;
      const double h = footprint.density(px - 4.5, py - 2.5);
      weight += h, true_x += h * px, true_squares += h * px * py, even_x += px / (kFine * kFine);
    }
  constexpr double kError = 3e-5;
  EXPECT_NEAR(x, true_x / weight, kError);
  EXPECT_NEAR(squares, true_squares / weight, 5.0 * kError);
  EXPECT_GT(std::abs(even_x - true_x / weight), 10.0 * kError) << "even points would do as well";
}

constexpr PixelRect kImage{0, 0, 16, 16};

/// TwoLevelField with a disc that shines in every second pixel of the image, off its borders.
class SpotField final : public test::TwoLevelField {
 public:
  static constexpr double kRadius = 0.01, kRadiance = 2e4;
  static bool has_spot(int i, int j) {
    return (i + j) % 2 == 0 && i >= kImage.x0 && i < kImage.x1 && j >= kImage.y0 && j < kImage.y1;
  }
  static FocalPoint spot(int i, int j) {
    const auto within = [&](int axis) { return 0.02 + 0.96 * unit_double(hash(i, j, axis)); };
    return {i + within(1), j + within(2)};
  }

  void levels(const LevelRequests& of, LevelSums& sums) override { Field::levels(of, sums); }
  void values(std::span<const PathRequest> requests, std::span<Label> labels,
              std::span<float> values) override {
    TwoLevelField::values(requests, labels, values);
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const FocalPoint p = requests[k].point;
      const int i = static_cast<int>(std::floor(p.x_px)), j = static_cast<int>(std::floor(p.y_px));
      if (!has_spot(i, j)) continue;
      const FocalPoint s = spot(i, j);
      if (std::hypot(p.x_px - s.x_px, p.y_px - s.y_px) < kRadius)
        values[k * static_cast<std::size_t>(stride())] += static_cast<float>(kRadiance);
    }
  }
};

struct Judged {
  double squared = 0.0, stated = 0.0, limit = 0.0, held = 0.0;
};

/// Over seeds, of column 0: mean squared error, that which is stated, its limit, and the share of half-widths that hold.
Judged judge(const PixelFootprint& footprint, bool told, double sigma) {
  const PixelRect image = kImage;
  std::vector<FocalPoint> spots;
  std::vector<BrightPlaces::Box> boxes;
  for (int j = image.y0; j < image.y1; ++j)
    for (int i = image.x0; i < image.x1; ++i)
      if (SpotField::has_spot(i, j)) {
        spots.push_back(SpotField::spot(i, j));
        boxes.push_back({spots.back(), 1.2 * SpotField::kRadius, 1.2 * SpotField::kRadius});
      }
  const BrightPlaces places(boxes);
  const test::ShareOfMean tolerance(0.02);
  const ImageSampler sampler(4096);
  // What lies under the footprint of the ground, by a fine grid; what the spots add, exactly.
  std::vector<double> truth;
  const SpotField ground;
  const auto within = [&](double from, double at) {
    return sigma > 0.0 ? gaussian(at - from - 0.5, sigma) : (at >= from && at < from + 1.0 ? 1.0 : 0.0);
  };
  const double light = SpotField::kRadiance * std::numbers::pi * SpotField::kRadius * SpotField::kRadius;
  for (int j = image.y0; j < image.y1; ++j)
    for (int i = image.x0; i < image.x1; ++i) {
      double value = 0.0;
      if (sigma > 0.0) {
        for (int b = -2; b <= 2; ++b)
          for (int a = -2; a <= 2; ++a)
            value +=
                footprint.integral(a - 0.5, b - 0.5, a + 0.5, b + 0.5) * ground.truth(i + a, j + b, 0, 20);
      } else {
        value = ground.truth(i, j, 0, 80);
      }
      for (const FocalPoint& spot : spots) value += light * within(i, spot.x_px) * within(j, spot.y_px);
      truth.push_back(value);
    }
  Judged sum;
  constexpr int kSeeds = 4;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SpotField field;
    TileProblem problem;
    problem.image = problem.tile = image;
    problem.seed = seed;
    problem.footprint = &footprint;
    problem.tolerance = &tolerance;
    if (told) problem.bright = &places;
    const auto survey = sampler.survey({problem, [&] { return std::make_unique<SpotField>(); }, 1});
    problem.survey = survey.get();
    TileResult tile;
    sampler.sample(problem, field, tile);
    const double pixels = static_cast<double>(truth.size()) * kSeeds;
    sum.limit = static_cast<double>(tile.column_errors[0].limit);
    sum.stated += tile.column_errors[0].variance_sum / pixels;
    for (std::size_t p = 0; p < truth.size(); ++p) {
      const double e = static_cast<double>(tile.mean[p * SpotField::kColumns]) - truth[p];
      sum.squared += e * e / pixels;
      sum.held += (std::abs(e) <= static_cast<double>(tile.half_width[p * SpotField::kColumns])) / pixels;
    }
  }
  return sum;
}

TEST(BrightPlaces, ImagesErrByWhatIsStated) {
  const PixelFootprint pixel = PixelFootprint::box(1.0);
  const Judged told = judge(pixel, true, 0.0);
  EXPECT_LT(std::sqrt(told.squared), 1.1 * told.limit);
  EXPECT_GT(std::sqrt(told.stated / told.squared), 0.8);
  EXPECT_LT(std::sqrt(told.stated / told.squared), 1.25);
  EXPECT_GT(told.held, 0.92);
  // Who is not told of them meets them by chance.
  const Judged untold = judge(pixel, false, 0.0);
  EXPECT_GT(std::sqrt(untold.squared), 10.0 * told.limit);
}

TEST(BrightPlaces, ImagesUnderAPsfErrByWhatIsStated) {
  const PixelFootprint footprint = gaussian_footprint();
  const Judged told = judge(footprint, true, 0.5);
  EXPECT_LT(std::sqrt(told.squared), 1.1 * told.limit);
  EXPECT_GT(std::sqrt(told.stated / told.squared), 0.8);
  EXPECT_GT(told.held, 0.92);
}

}  // namespace
}  // namespace ifov::sampling::test_bright_places
