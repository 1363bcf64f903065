#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "image_scenes.h"
#include "sampling/grid_sampler.h"
#include "sampling/image/allocation.h"
#include "sampling/image/audit.h"
#include "sampling/image/audited_pixels.h"
#include "sampling/image/audited_sampler.h"
#include "sampling/image/image_plan.h"
#include "sampling/image/image_sampler.h"
#include "sampling/image/spread_places.h"
#include "sampling/image/survey.h"
#include "sampling/pixel_footprint.h"
#include "shape_field.h"

namespace ifov::sampling::test_image_sampler {
namespace {

using test::ShareOfMean;
using test::TwoLevelField;

const PixelFootprint kPixel = PixelFootprint::box(1.0);
constexpr std::uint32_t kManySamples = 4096;

struct Rendering {
  TileResult tile;
  std::unique_ptr<const ImageSurvey> survey;
};

/// An image, whole or tile by tile.
Rendering render(const PixelSampler& sampler, const TwoLevelField& scene, PixelRect image, std::uint64_t seed,
                 const Tolerance* tolerance, int tile_px = 0, int threads = 1) {
  TileProblem problem;
  problem.image = problem.tile = image;
  problem.seed = seed;
  problem.footprint = &kPixel;
  problem.tolerance = tolerance;
  Rendering all;
  all.survey = sampler.survey({problem, [&] { return std::make_unique<TwoLevelField>(scene); }, threads});
  problem.survey = all.survey.get();
  if (tile_px == 0) {
    TwoLevelField field = scene;
    sampler.sample(problem, field, all.tile);
    return all;
  }
  all.tile.reset(image, TwoLevelField::kColumns);
  for (int y = image.y0; y < image.y1; y += tile_px)
    for (int x = image.x0; x < image.x1; x += tile_px) {
      problem.tile = {x, y, std::min(x + tile_px, image.x1), std::min(y + tile_px, image.y1)};
      TwoLevelField field = scene;
      TileResult part;
      sampler.sample(problem, field, part);
      const int columns = TwoLevelField::kColumns;
      for (int p = 0; p < problem.tile.count(); ++p)
        for (int c = 0; c < columns; ++c) {
          const int at =
              ((y + p / problem.tile.width()) * image.width() + x + p % problem.tile.width()) * columns + c;
          all.tile.mean[static_cast<std::size_t>(at)] = part.mean[static_cast<std::size_t>(p * columns + c)];
          all.tile.half_width[static_cast<std::size_t>(at)] =
              part.half_width[static_cast<std::size_t>(p * columns + c)];
        }
    }
  return all;
}

std::vector<double> truth_of(const TwoLevelField& scene, PixelRect image, int n = 80) {
  std::vector<double> truth;
  for (int j = image.y0; j < image.y1; ++j)
    for (int i = image.x0; i < image.x1; ++i)
      for (int c = 0; c < TwoLevelField::kColumns; ++c) truth.push_back(scene.truth(i, j, c, n));
  return truth;
}

/// By column: mean squared error of an image, and that which it states before and with an audit.
struct Errors {
  double squared = 0.0, stated = 0.0, audited = 0.0, covered = 0.0;
};
Errors errors_of(const TileResult& tile, const std::vector<double>& truth, std::size_t c) {
  Errors errors;
  const double pixels = static_cast<double>(tile.samples.size());
  for (std::size_t at = c; at < truth.size(); at += TwoLevelField::kColumns) {
    const double e = static_cast<double>(tile.mean[at]) - truth[at];
    errors.squared += e * e / pixels;
    errors.covered += (std::abs(e) <= static_cast<double>(tile.half_width[at]) ? 1.0 : 0.0) / pixels;
  }
  errors.stated = tile.column_errors[c].variance_sum / pixels;
  errors.audited = errors.stated * static_cast<double>(tile.column_errors[c].audited);
  return errors;
}

TEST(ImageSampler, ErrsByWhatWasAskedAndSaysSo) {
  const TwoLevelField scene;
  const PixelRect image{0, 0, 24, 24};
  const std::vector<double> truth = truth_of(scene, image);
  for (const double share : {0.03, 0.01}) {
    const ShareOfMean tolerance(share);
    const ImageSampler sampler(kManySamples);
    double squared[2] = {}, stated[2] = {};
    constexpr int kSeeds = 6;
    double limit[2] = {};
    for (int seed = 0; seed < kSeeds; ++seed) {
      const Rendering r = render(sampler, scene, image, static_cast<std::uint64_t>(seed), &tolerance);
      for (std::size_t c = 0; c < 2; ++c) {
        const Errors errors = errors_of(r.tile, truth, c);
        squared[c] += errors.squared / kSeeds;
        stated[c] += errors.stated / kSeeds;
        limit[c] = static_cast<double>(r.tile.column_errors[c].limit);
      }
    }
    double closest = 0.0;
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_GT(std::sqrt(stated[c] / squared[c]), 0.85) << share << " column " << c;
      EXPECT_LT(std::sqrt(stated[c] / squared[c]), 1.15) << share << " column " << c;
      EXPECT_LT(std::sqrt(squared[c]), 1.1 * limit[c]) << share << " column " << c;
      closest = std::max(closest, std::sqrt(squared[c]) / limit[c]);
    }
    EXPECT_GT(closest, 0.7) << share;
  }
}

/// Of the sums over seeds of pixels' errors, in their own standard errors.
/// Without pooling, which trades bias for noise.
double mean_square_bias(const TwoLevelField& scene, const TwoLevelField& truth_scene, int seeds) {
  const PixelRect image{0, 0, 6, 4};
  const std::vector<double> truth = truth_of(truth_scene, image, 200);
  const ShareOfMean tolerance(0.02);
  const ImageSampler sampler(kManySamples, {.on = false});
  std::vector<double> sum(truth.size(), 0.0), squares(truth.size(), 0.0);
  for (int seed = 0; seed < seeds; ++seed) {
    const Rendering r = render(sampler, scene, image, 1000 + static_cast<std::uint64_t>(seed), &tolerance);
    for (std::size_t at = 0; at < truth.size(); ++at) {
      const double e = static_cast<double>(r.tile.mean[at]) - truth[at];
      sum[at] += e;
      squares[at] += e * e;
    }
  }
  double z2 = 0.0;
  for (std::size_t at = 0; at < truth.size(); ++at) z2 += sum[at] * sum[at] / squares[at];
  return z2 / static_cast<double>(truth.size());
}

TEST(ImageSampler, IsUnbiasedPixelByPixel) {
  // Small bright spots, which a pilot sees or not and the plan follows: where pilots entered by what they led to, means would be low.
  TwoLevelField scene;
  scene.wire_width_px = 0.05;
  scene.wire_radiance = 10.0;
  scene.wire_period = 2;
  // The mean of 48 squares of standard normal numbers, the columns alike and pixels of one plan: other 300 seeds gave 0.6, 1.0 and 2.0,
  // and the fault 123.
  EXPECT_LT(mean_square_bias(scene, scene, 150), 3.0);
  TwoLevelField faulty = scene;
  faulty.rest_factor = 0.98;
  EXPECT_GT(mean_square_bias(faulty, scene, 150), 3.0);
}

TEST(ImageSampler, GivesTheSameInAnyTilesAndThreads) {
  const TwoLevelField scene;
  const PixelRect image{0, 0, 21, 13};
  const ShareOfMean tolerance(0.02);
  for (const bool pooling : {false, true}) {
    const AuditedSampler sampler(
        std::make_unique<ImageSampler>(kManySamples, ImageSampler::Pooling{.on = pooling}), 40);
    const Rendering whole = render(sampler, scene, image, 3, &tolerance, 0, 1);
    for (const int tile : {5, 8}) {
      const Rendering parts = render(sampler, scene, image, 3, &tolerance, tile, 2);
      EXPECT_EQ(parts.tile.mean, whole.tile.mean);
      EXPECT_EQ(parts.tile.half_width, whole.tile.half_width);
    }
  }
}

TEST(ImageSampler, SpendsWhereTheErrorIs) {
  TwoLevelField scene;
  scene.noise = 0.05;
  scene.ripple = 0.01;
  const ShareOfMean tolerance(0.01);
  const Rendering r = render(ImageSampler(kManySamples), scene, {0, 0, 16, 16}, 1, &tolerance);
  const std::vector<Audit::PixelClass> classes = classes_of(r.tile);
  double pure = 0.0, mixed = 0.0, pure_count = 0.0, mixed_count = 0.0;
  for (std::size_t p = 0; p < classes.size(); ++p) {
    (classes[p] == Audit::kPure ? pure : mixed) += r.tile.samples[p];
    (classes[p] == Audit::kPure ? pure_count : mixed_count) += 1.0;
  }
  ASSERT_GT(pure_count, 20.0);
  ASSERT_GT(mixed_count, 20.0);
  EXPECT_GT(mixed / mixed_count, 1.3 * pure / pure_count);
}

TEST(ImageSampler, NeedsToKnowTheImage) {
  TwoLevelField field;
  TileProblem problem;
  problem.image = problem.tile = {0, 0, 2, 2};
  problem.footprint = &kPixel;
  TileResult result;
  EXPECT_THROW(ImageSampler(64).sample(problem, field, result), std::invalid_argument);
  EXPECT_THROW(AuditedSampler(std::make_unique<GridSampler>(2, 2), 3), std::invalid_argument);
}

TEST(Allocation, MeetsEveryLimitAndNoneByMuch) {
  // Two kinds of pixels that matter to one column each.
  const LevelVariances rough_one{{4.0, 0.1}, {0.5, 0.1}, {}}, smooth_one{{0.01, 0.1}, {0.01, 0.1}, {}};
  std::vector<SurveyedPixel> pixels;
  for (int p = 0; p < 100; ++p)
    pixels.push_back(p % 4 == 0 ? SurveyedPixel{rough_one, rough_one}
                                : SurveyedPixel{smooth_one, smooth_one});
  const Allocation allocation(pixels, {0.01, 0.01}, 2.0, kManySamples);
  for (const double planned : allocation.planned()) {
    EXPECT_LE(planned, 1.01);
    EXPECT_GT(planned, 0.7);
  }
  const PixelPlan rough = allocation.plan(allocation.sizes(rough_one)),
                  smooth = allocation.plan(allocation.sizes(smooth_one));
  EXPECT_GT(rough.count(), 3 * smooth.count());
  EXPECT_LE(smooth.whole, smooth.count());
}

TEST(PixelPoints, FollowEachCellWithTheSameChance) {
  const PixelPlan plan{6, 8, 13};
  std::vector<int> followed(48, 0);
  constexpr int kPixels = 4000;
  for (int i = 0; i < kPixels; ++i) {
    PixelPoints points;
    points.add(kPixel, i, 0, hash(7, i), plan);
    ASSERT_EQ(points.requests.size(), 48u);
    std::uint32_t whole = 0;
    for (std::size_t k = 0; k < 48; ++k) {
      whole += points.whole[k];
      const FocalPoint at = points.requests[k].point;
      ASSERT_EQ(std::floor(at.x_px), i);
      const int cell = static_cast<int>((at.y_px) * 8) * 6 + static_cast<int>((at.x_px - i) * 6);
      followed[static_cast<std::size_t>(cell)] += points.whole[k];
    }
    ASSERT_EQ(whole, 13u);
  }
  double chi2 = 0.0;
  const double wanted = kPixels * 13.0 / 48.0;
  for (const int n : followed) chi2 += (n - wanted) * (n - wanted) / (wanted * (1.0 - 13.0 / 48.0));
  EXPECT_LT(chi2, 90.0);  // 47 degrees of freedom: 1 in 10,000
}

TEST(SpreadPlaces, AreAllOrLieEvenly) {
  EXPECT_EQ(spread_places({2, 3, 6, 5}, 10, 1).size(), 8u);
  std::vector<int> quarters(4, 0);
  for (const Place& place : spread_places({0, 0, 100, 60}, 400, 5)) {
    ASSERT_GE(place.i, 0);
    ASSERT_LT(place.i, 100);
    ASSERT_LT(place.j, 60);
    ++quarters[static_cast<std::size_t>(2 * (place.j / 30) + place.i / 50)];
  }
  for (const int n : quarters) EXPECT_NEAR(n, 100, 5);
}

TEST(Audit, CalibratesIntervalsAndTheImagesErrorWhateverTheSampler) {
  const TwoLevelField scene;
  const PixelRect image{0, 0, 32, 32};
  const std::vector<double> truth = truth_of(scene, image);
  const ShareOfMean tolerance(0.02);
  const AuditedSampler by_image(std::make_unique<ImageSampler>(kManySamples), 200),
      by_grid(std::make_unique<GridSampler>(5, 5), 200);
  for (const PixelSampler* sampler :
       {static_cast<const PixelSampler*>(&by_image), static_cast<const PixelSampler*>(&by_grid)}) {
    constexpr int kSeeds = 4;
    double covered = 0.0, told = 0.0;
    for (int seed = 0; seed < kSeeds; ++seed) {
      const Rendering r = render(*sampler, scene, image, 50 + static_cast<std::uint64_t>(seed), &tolerance);
      for (std::size_t c = 0; c < 2; ++c) {
        const Errors errors = errors_of(r.tile, truth, c);
        covered += errors.covered / (2 * kSeeds);
        told += std::sqrt(errors.audited / errors.squared) / (2 * kSeeds);
      }
    }
    EXPECT_GT(covered, 0.93);
    EXPECT_LT(covered, 0.975);
    EXPECT_NEAR(told, 1.0, 0.12);
  }
}

/// Told by an audit over what is stated without one.
double found(const TwoLevelField& scene, double share) {
  const ShareOfMean tolerance(share);
  const AuditedSampler sampler(std::make_unique<ImageSampler>(kManySamples), 200);
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Rendering r = render(sampler, scene, {0, 0, 32, 32}, seed, &tolerance);
    sum += std::sqrt(static_cast<double>(r.tile.column_errors[0].audited)) / 3.0;
  }
  return sum;
}

TEST(Audit, FindsWhatTheSamplesCannot) {
  TwoLevelField scene;
  EXPECT_NEAR(found(scene, 0.02), 1.0, 0.2);
  // A sampler whose second level is not what it should be; and one whose variances fall by a wrong exponent.
  TwoLevelField biased = scene;
  biased.rest_factor = 0.5;
  EXPECT_GT(found(biased, 0.02), 1.5);
  TwoLevelField sure = scene;
  sure.wrong_exponent = true;
  sure.noise = 0.01;
  sure.ripple = 0.3;
  EXPECT_GT(found(sure, 0.002), 1.3 * found(sure, 0.05));  // at few strata it is right
}

TEST(Audit, FindsWiresThatNoSampleMeets) {
  TwoLevelField scene;
  scene.ripple = scene.noise = 0.0;
  scene.border_period_px = 1e4;
  scene.wire_width_px = 0.02;
  scene.wire_radiance = 30.0;
  scene.blind_to_wires = true;
  const ShareOfMean tolerance(0.05);
  const PixelRect image{0, 0, 32, 32};
  const std::vector<double> truth = truth_of(scene, image);
  double told = 0.0, stated = 0.0, true_rms = 0.0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const AuditedSampler sampler(std::make_unique<ImageSampler>(16), 300);
    const Rendering r = render(sampler, scene, image, seed, &tolerance);
    const Errors errors = errors_of(r.tile, truth, 0);
    told += std::sqrt(errors.audited) / 4.0;
    stated += std::sqrt(errors.stated) / 4.0;
    true_rms += std::sqrt(errors.squared) / 4.0;
  }
  EXPECT_GT(true_rms, 10.0 * stated);
  EXPECT_NEAR(told / true_rms, 1.0, 0.3);
}

TEST(Allocation, ALimitOfOneColumnIsKeptWhereTheOthersAreFarWithinTheirs) {
  // At the least numbers all columns together are within their limits, and one alone is not.
  for (double loud = 0.05; loud < 1e4; loud *= 1.2) {
    std::vector<SurveyedPixel> pixels;
    for (int p = 0; p < 300; ++p) {
      LevelVariances of;
      of.direct.assign(20, 1e-3 * (1 + p % 7));
      of.rest.assign(20, 1e-3);
      of.direct[3] = p % 10 == 0 ? 10.0 * loud : 0.1 * loud;
      pixels.push_back({of, of});
    }
    const Allocation allocation(pixels, std::vector<double>(20, 0.3), 2.0, 100000);
    EXPECT_LE(allocation.planned()[3], 1.01) << loud;
    if (loud > 20.0) {
      EXPECT_GT(allocation.planned()[3], 0.6) << loud;
    }
  }
}

TEST(Audit, QuantilesAreThoseOfOneMorePixel) {
  std::vector<ConformalScore> scores;
  for (int k = 19; k >= 1; --k) scores.push_back({static_cast<double>(k), 1.0});
  EXPECT_EQ(conformal_quantile(scores, 0.95), 19.0);  // ceil(0.95 * 20)
  EXPECT_EQ(conformal_quantile(scores, 0.5), 10.0);
  EXPECT_EQ(conformal_quantile(scores, 0.99), 19.0);
  for (ConformalScore& score : scores) score.weight = score.score < 10.5 ? 3.0 : 1.0;
  EXPECT_EQ(conformal_quantile(scores, 0.5), 7.0);  // 21 of 39, of which 20.5 are wanted
}

}  // namespace
}  // namespace ifov::sampling::test_image_sampler
