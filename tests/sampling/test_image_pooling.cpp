#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "image_scenes.h"
#include "sampling/hash.h"
#include "sampling/image/allocation.h"
#include "sampling/image/audit.h"
#include "sampling/image/audited_sampler.h"
#include "sampling/image/image_sampler.h"
#include "sampling/image/like_pixels.h"
#include "sampling/image/rest_model.h"
#include "sampling/image/survey.h"
#include "sampling/pixel_footprint.h"
#include "sampling/random.h"

namespace ifov::sampling::test_image_pooling {
namespace {

using test::ShareOfMean;
using test::TwoLevelField;

const PixelFootprint kOnePixel = PixelFootprint::box(1.0);
using Shares = std::map<std::uint32_t, double>;

double normal(std::uint64_t key) {
  return std::sqrt(-2.0 * std::log(1.0 - unit_double(hash(key, 1)))) *
         std::cos(6.283185307179586 * unit_double(hash(key, 2)));
}

/// Mean squared error before and after, and what is stated after, of blocks whose pixels differ by `between`.
struct Shrunk {
  double before = 0.0, after = 0.0, stated = 0.0;
};
Shrunk shrunk(double between, double noise, double trust) {
  constexpr std::size_t kStride = 16;
  std::vector<Place> places;
  std::vector<Shares> shares;
  for (int k = 0; k < 64; ++k) {
    places.push_back({k % 8, k / 8});
    shares.push_back({{k % 8 < 4 ? 1u : 2u, 1.0}});
  }
  const LikePixels like(places, shares);
  const std::vector<double> before(1, between * between);
  Shrunk result;
  constexpr int kBlocks = 40;
  for (std::uint64_t b = 0; b < kBlocks; ++b) {
    std::vector<float> means(64 * kStride), variances(64 * kStride, static_cast<float>(noise * noise)),
        predicted(64 * kStride, 1.0f);
    std::vector<double> truth(64);
    for (std::size_t k = 0; k < 64; ++k) {
      // Two materials, of which the prediction knows nothing.
      truth[k] = (k % 8 < 4 ? 1.0 : 2.0) + between * normal(hash(b, k, 10));
      means[k * kStride] = static_cast<float>(truth[k] + noise * normal(hash(b, k, 11)));
      const double e = static_cast<double>(means[k * kStride]) - truth[k];
      result.before += e * e / 64 / kBlocks;
    }
    like.shrink({1, kStride, predicted, before, trust}, means, variances);
    for (std::size_t k = 0; k < 64; ++k) {
      const double e = static_cast<double>(means[k * kStride]) - truth[k];
      result.after += e * e / 64 / kBlocks;
      result.stated += static_cast<double>(variances[k * kStride]) / 64 / kBlocks;
    }
  }
  return result;
}

TEST(LikePixels, ShrinkByWhatPixelsDifferBy) {
  const Shrunk alike = shrunk(0.0, 0.2, 1.0);
  EXPECT_LT(alike.after, 0.35 * alike.before);
  // Pixels of scenes are never so alike: some of the error that they are taken to have is not there.
  EXPECT_GT(std::sqrt(alike.stated / alike.after), 1.0);
  EXPECT_LT(std::sqrt(alike.stated / alike.after), 1.35);
  // Where pixels differ by more than their noise nothing is gained and nothing lost.
  const Shrunk unlike = shrunk(0.6, 0.2, 1.0);
  EXPECT_LT(unlike.after, 1.05 * unlike.before);
  EXPECT_NEAR(std::sqrt(unlike.stated / unlike.after), 1.0, 0.15);
  // Planted: the same where differences are not believed.
  const Shrunk blind = shrunk(0.6, 0.2, 0.0);
  EXPECT_GT(blind.after, 2.0 * blind.before);
  EXPECT_LT(std::sqrt(blind.stated / blind.after), 0.5);
}

TEST(LikePixels, OfOtherMaterialsTellNothing) {
  const std::vector<Place> places{{0, 0}, {1, 0}, {2, 0}};
  const std::vector<Shares> shares{{{1, 1.0}}, {{2, 1.0}}, {{1, 1.0}}};
  const std::vector<double> smoothed =
      LikePixels(places, shares).smoothed(std::vector<double>{1.0, 100.0, 3.0}, std::vector<double>{0, 0, 0});
  EXPECT_GT(smoothed[0], 1.0);
  EXPECT_LT(smoothed[0], 1.5);
  EXPECT_EQ(smoothed[1], 0.0);
}

TEST(RestModel, FindsSharesAndTheFirstLevel) {
  // rest = 1 of material 4, 3 of material 9, and a fifth of the first level.
  std::vector<std::vector<double>> direct, rest;
  std::vector<RestModel::Pixel> pixels;
  for (int k = 0; k < 200; ++k) {
    const double share = unit_double(hash(5, k)), d = 2.0 + normal(hash(6, k));
    direct.push_back({d, 2.0 * d});
    rest.push_back({share + 3.0 * (1.0 - share) + 0.2 * d, 7.0});
    pixels.push_back({{{4, share}, {9, 1.0 - share}}, {}, {}});
  }
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    pixels[k].direct = direct[k];
    pixels[k].rest = rest[k];
  }
  const RestModel model(pixels);
  std::vector<double> d{3.0, 6.0}, found(2);
  model.predict(Shares{{4, 1.0}}, d.data(), found.data());
  EXPECT_NEAR(found[0], 1.6, 0.08);
  EXPECT_NEAR(found[1], 7.0, 1e-6);
  model.predict(Shares{{9, 1.0}}, d.data(), found.data());
  EXPECT_NEAR(found[0], 3.6, 0.08);
  // Of a material that was not met: as of all.
  d = {2.0, 4.0};
  model.predict(Shares{{77, 1.0}}, d.data(), found.data());
  EXPECT_NEAR(found[0], 2.4, 0.2);
}

/// Three columns, of which the first is the sum of the others, through the model and the shrinkage: by how much it is no longer, at most.
double parts_off(std::span<const std::size_t> leaders) {
  constexpr std::size_t kColumns = 3, kStride = 16, kPixels = 64;
  std::vector<Place> places;
  std::vector<Shares> shares;
  std::vector<std::vector<double>> direct, rest;
  std::vector<RestModel::Pixel> pixels;
  std::vector<float> means(kPixels * kStride), variances(kPixels * kStride), predicted(kPixels * kStride);
  for (std::size_t k = 0; k < kPixels; ++k) {
    places.push_back({static_cast<int>(k % 8), static_cast<int>(k / 8)});
    const double share = unit_double(hash(21, k));
    shares.push_back({{1, share}, {2, 1.0 - share}});
    const double d = 2.0 + normal(hash(22, k)), a = share + 0.3 * normal(hash(23, k)),
                 b = 2.0 + d + normal(hash(24, k));
    direct.push_back({d + share, d, share});
    rest.push_back({a + b, a, b});
    for (std::size_t c = 0; c < kColumns; ++c) {
      means[k * kStride + c] = static_cast<float>(rest[k][c]);
      variances[k * kStride + c] = static_cast<float>(c == 1 ? 0.02 : 1.0);
    }
  }
  for (std::size_t k = 0; k < kPixels; ++k) pixels.push_back({shares[k], direct[k], rest[k]});
  const RestModel model(pixels, leaders);
  for (std::size_t k = 0; k < kPixels; ++k) {
    std::vector<float> first(direct[k].begin(), direct[k].end());
    model.predict(shares[k], first.data(), &predicted[k * kStride]);
  }
  const std::vector<double> between{0.2, 0.1, 0.4};
  LikePixels(places, shares).shrink({kColumns, kStride, predicted, between, 1.0, leaders}, means, variances);
  double most = 0.0;
  for (std::size_t k = 0; k < kPixels; ++k) {
    const float* mean = &means[k * kStride];
    most = std::max(most, static_cast<double>(std::abs(mean[0] - mean[1] - mean[2])));
    EXPECT_GT(variances[k * kStride + 1], 0.0f);
  }
  return most;
}

TEST(Pooling, PartsThatFollowGoOnAddingUp) {
  EXPECT_LT(parts_off(std::vector<std::size_t>{0, 0, 0}), 5e-6);
  EXPECT_GT(parts_off(std::vector<std::size_t>{0, 1, 2}), 0.05) << "each by its own values";
}

TEST(Allocation, RarePixelsOfAnEasyColumnGetTheirValues) {
  // The first column is dear in all pixels; the second only noisy in a few, and within its limit whatever they get: a tree's near
  // infrared in a street. What takes that error away costs next to nothing.
  const LevelVariances street{{4.0, 0.01}, {0.5, 0.01}, {0.0, 0.0}},
      tree{{4.0, 0.01}, {0.5, 60.0}, {0.0, 60.0}};
  std::vector<SurveyedPixel> pixels;
  for (int p = 0; p < 100; ++p)
    pixels.push_back(p % 50 == 0 ? SurveyedPixel{tree, tree} : SurveyedPixel{street, street});
  const Allocation allocation(pixels, {0.02, 0.1}, 2.0, 10000);
  for (const double planned : allocation.planned()) EXPECT_LE(planned, 1.01);
  EXPECT_GT(allocation.plan(allocation.sizes(tree)).whole, 60u);
  EXPECT_LT(allocation.plan(allocation.sizes(street)).whole, 40u);
}

struct Found {
  double squared = 0.0, stated = 0.0, audited = 0.0, values = 0.0;
};
Found render(const TwoLevelField& scene, ImageSampler::Pooling pooling, int audit) {
  const ShareOfMean tolerance(0.01);
  const PixelRect image{0, 0, 32, 32};
  TileProblem problem;
  problem.image = problem.tile = image;
  problem.footprint = &kOnePixel;
  problem.tolerance = &tolerance;
  std::unique_ptr<PixelSampler> sampler = std::make_unique<ImageSampler>(4096u, pooling);
  if (audit > 0) sampler = std::make_unique<AuditedSampler>(std::move(sampler), audit);
  std::vector<double> truth;
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 32; ++i) truth.push_back(scene.truth(i, j, 0, 60));
  Found found;
  constexpr std::uint64_t kSeeds = 3;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    problem.seed = seed;
    const std::unique_ptr<const ImageSurvey> survey =
        sampler->survey({problem, [&] { return std::make_unique<TwoLevelField>(scene); }, 1});
    problem.survey = survey.get();
    TwoLevelField field = scene;
    TileResult tile;
    sampler->sample(problem, field, tile);
    for (std::size_t p = 0; p < truth.size(); ++p) {
      const double e = static_cast<double>(tile.mean[p * TwoLevelField::kColumns]) - truth[p];
      found.squared += e * e / 1024 / kSeeds;
      found.values += tile.samples[p] / 1024.0 / kSeeds;
    }
    found.stated += tile.column_errors[0].variance_sum / 1024 / kSeeds;
    found.audited += tile.column_errors[0].variance_sum * static_cast<double>(tile.column_errors[0].audited) /
                     1024 / kSeeds;
  }
  return found;
}

TEST(ImagePooling, TakesFewerValuesForTheSameError) {
  TwoLevelField scene;
  scene.ripple = 0.01;
  scene.noise = 1.0;
  const Found pooled = render(scene, {.on = true}, 0), alone = render(scene, {.on = false}, 0);
  EXPECT_LT(pooled.values * pooled.squared, 0.75 * alone.values * alone.squared);
  // Where all that are alike are the same, more is stated than there is: by what is always left for differences.
  EXPECT_GT(std::sqrt(pooled.stated / pooled.squared), 0.85);
  EXPECT_LT(std::sqrt(pooled.stated / pooled.squared), 1.5);
}

TEST(ImagePooling, AuditFindsPooledShadows) {
  // Sky that some streets see and others do not, which nothing else tells apart. Where what pixels differ by is measured the image is as
  // it says; planted: where it is not believed, the audit tells.
  TwoLevelField scene;
  scene.noise = 1.0;
  scene.canyon = 0.6;
  const Found measured = render(scene, {.on = true}, 200);
  EXPECT_NEAR(std::sqrt(measured.audited / measured.squared), 1.0, 0.2);
  EXPECT_NEAR(std::sqrt(measured.stated / measured.squared), 1.0, 0.25);
  const Found blind = render(scene, {.on = true, .trust = 0.0}, 200);
  EXPECT_GT(blind.squared, 2.0 * measured.squared);
  EXPECT_LT(std::sqrt(blind.stated / blind.squared), 0.7);
  EXPECT_NEAR(std::sqrt(blind.audited / blind.squared), 1.0, 0.25);
}

}  // namespace
}  // namespace ifov::sampling::test_image_pooling
