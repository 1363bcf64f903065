#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "core/error.h"
#include "materials/texture_map.h"
#include "sampling/random.h"

namespace ifov::materials::test_texture_map {
namespace {

constexpr MapGrid kOneCell{0.0, 1.0, 1.0, 1.0, 1, 1};

template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

CurveMix match(const CurveMatcher& matcher, std::vector<double> scores, std::uint64_t key = 1) {
  return matcher.match(scores, key);
}

/// The score of the mixture in a range, which the match is to reproduce.
double score_of(const CurveMatcher& matcher, const CurveMix& mix, std::size_t range) {
  return (1.0 - mix.second_share) * matcher.score(mix.first, range) +
         mix.second_share * matcher.score(mix.second, range);
}

TEST(CurveMatcher, ScoresAgainstTheClosedForm) {
  // Means 0.1, 0.2, 0.6: mean 0.3, standard deviation sqrt((0.04 + 0.01 + 0.09) / 3).
  const CurveMatcher matcher({0.2, 0.6, 0.1}, 1);
  const double deviation = std::sqrt(0.14 / 3.0);
  EXPECT_NEAR(matcher.mean(0), 0.3, 1e-15);
  EXPECT_NEAR(matcher.deviation(0), deviation, 1e-15);
  EXPECT_NEAR(matcher.score(1, 0), 0.3 / deviation, 1e-14);

  // A score of 0 is a reflectance of 0.3: a quarter of the way from curve 0 (0.2) to curve 1 (0.6).
  const CurveMix middle = match(matcher, {0.0});
  EXPECT_EQ(middle.first, 0u);
  EXPECT_EQ(middle.second, 1u);
  EXPECT_NEAR(middle.second_share, 0.25, 1e-12);
  // Beyond the outermost curves they stand alone.
  EXPECT_EQ(match(matcher, {-5.0}).first, 2u);
  EXPECT_EQ(match(matcher, {-5.0}).second_share, 0.0);
  EXPECT_EQ(match(matcher, {9.0}).first, 1u);
}

TEST(CurveMatcher, EveryScoreBetweenTheCurvesIsReproduced) {
  std::vector<double> means;
  for (int c = 0; c < 20; ++c) means.push_back(0.1 + 0.8 * sampling::unit_double(sampling::hash(7, c)));
  const CurveMatcher matcher(means, 1);
  for (double score = -1.0; score <= 1.0; score += 0.01)
    EXPECT_NEAR(score_of(matcher, match(matcher, {score}), 0), score, 1e-12);
}

TEST(CurveMatcher, TheSearchInManyRangesAgreesWithThatInOne) {
  // A second range that says the same as the first makes distances longer by sqrt(2) and changes nothing else.
  std::vector<double> once, twice;
  for (int c = 0; c < 12; ++c) {
    const double mean = 0.2 + 0.5 * sampling::unit_double(sampling::hash(3, c));
    once.push_back(mean);
    twice.insert(twice.end(), {mean, mean});
  }
  const CurveMatcher one(once, 1), two(twice, 2);
  for (double score = -2.5; score <= 2.5; score += 0.037) {
    const CurveMix a = match(one, {score}), b = match(two, {score, score});
    EXPECT_NEAR(score_of(one, a, 0), score_of(two, b, 0), 1e-9) << score;
  }
}

TEST(CurveMatcher, TwoRangesTellCurvesApartThatOneCannot) {
  // Alike in the first range by pairs, unlike in the second.
  const CurveMatcher matcher({0.2, 0.1, 0.2, 0.5, 0.4, 0.1, 0.4, 0.5}, 2);
  for (std::uint32_t c = 0; c < 4; ++c) {
    const CurveMix mix = match(matcher, {matcher.score(c, 0), matcher.score(c, 1)});
    EXPECT_EQ(mix.first, c);
    EXPECT_NEAR(mix.second_share, 0.0, 1e-12);
  }
  const CurveMix mix =
      match(matcher, {matcher.score(0, 0), 0.2 * matcher.score(0, 1) + 0.8 * matcher.score(1, 1)});
  EXPECT_EQ(mix.first, 1u);
  EXPECT_EQ(mix.second, 0u);
  EXPECT_NEAR(mix.second_share, 0.2, 1e-12);
}

TEST(CurveMatcher, CovarianceCountsRangesThatGoTogetherOnce) {
  // The first two ranges are nearly the same and the third is independent of them.
  std::vector<double> means;
  for (int k = 0; k < 4; ++k)
    for (int sign : {-1, 1}) {
      const double together = (k & 1) != 0 ? sign : -sign, own = (k & 2) != 0 ? sign : -sign,
                   small = 0.3 * sign;
      means.insert(means.end(), {0.5 + 0.1 * together, 0.5 + 0.1 * (together + small), 0.5 + 0.1 * own});
    }
  const CurveMatcher plain(means, 3), covariance(means, 3, CurveMatcher::Distance::covariance);
  // Correlations of these means in closed form: together and small are uncorrelated, so R01 = 1 / sqrt(1 + 0.09).
  const double r = 1.0 / std::sqrt(1.09);
  const auto mahalanobis = [&](std::span<const double> d) {
    return (d[0] * d[0] - 2.0 * r * d[0] * d[1] + d[1] * d[1]) / (1.0 - r * r) + d[2] * d[2];
  };
  int differ = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> scores;
    for (int j = 0; j < 3; ++j) scores.push_back(4.0 * sampling::unit_double(sampling::hash(trial, j)) - 2.0);
    std::uint32_t expected = 0;
    double best = INFINITY;
    for (std::uint32_t c = 0; c < 8; ++c) {
      const double d[] = {scores[0] - covariance.score(c, 0), scores[1] - covariance.score(c, 1),
                          scores[2] - covariance.score(c, 2)};
      if (mahalanobis(d) < best - 1e-9) {
        best = mahalanobis(d);
        expected = c;
      }
    }
    const CurveMix mix = match(covariance, scores);
    EXPECT_EQ(mix.first, expected) << trial;
    differ += match(plain, scores).first != expected;
  }
  EXPECT_GT(differ, 10);
}

TEST(CurveMatcher, EqualCurvesAreDrawnByTheKey) {
  const CurveMatcher matcher({0.2, 0.4, 0.4, 0.4, 0.9}, 1),
      in_two({0.2, 0.1, 0.4, 0.3, 0.4, 0.3, 0.9, 0.8}, 2);
  std::map<std::uint32_t, int> drawn, drawn_in_two;
  for (std::uint64_t key = 0; key < 3000; ++key) {
    const CurveMix mix = match(matcher, {matcher.score(1, 0)}, key);
    ++drawn[mix.first];
    EXPECT_NEAR(mix.second_share, 0.0, 1e-9);
    EXPECT_EQ(match(matcher, {matcher.score(1, 0)}, key).first, mix.first);
    ++drawn_in_two[match(in_two, {in_two.score(1, 0), in_two.score(1, 1)}, key).first];
  }
  ASSERT_EQ(drawn.size(), 3u);
  for (std::uint32_t c = 1; c <= 3; ++c) EXPECT_NEAR(drawn[c], 1000, 5 * std::sqrt(3000.0 * 2.0 / 9.0));
  ASSERT_EQ(drawn_in_two.size(), 2u);
  EXPECT_NEAR(drawn_in_two[1], 1500, 5 * std::sqrt(750.0));
}

TEST(CurveMatcher, WhatCannotBeMatchedIsSaid) {
  EXPECT_EQ(error_of([] { CurveMatcher({0.3}, 1); }),
            "a texture needs at least 2 curves to choose from: found 1");
  EXPECT_EQ(error_of([] {
              CurveMatcher({0.3, 0.1, 0.3, 0.2}, 2);
            }),
            "all curves have the same mean, 0.3, in spectral range 1");
  EXPECT_NE(error_of([] {
              CurveMatcher({0.1, 0.2, 0.2, 0.4, 0.4, 0.8}, 2, CurveMatcher::Distance::covariance);
            }).find("in spectral range 2 follow from those in the ranges before it"),
            std::string::npos);
}

TEST(ImageScores, AreThoseOfItsOwnNumbers) {
  const std::vector<float> values{10.0f, 20.0f, -1.0f, 60.0f};
  const ImageScores scores = score_image(values, -1.0);
  EXPECT_EQ(scores.unknown, 1u);
  EXPECT_DOUBLE_EQ(scores.mean, 30.0);
  EXPECT_NEAR(scores.deviation, std::sqrt(1400.0 / 3.0), 1e-12);
  EXPECT_NEAR(static_cast<double>(scores.scores[3]), 30.0 / scores.deviation, 1e-6);
  EXPECT_EQ(scores.scores[2], 0.0f);
  EXPECT_EQ(error_of([] {
              score_image(std::vector<float>{3.0f, 3.0f}, {});
            }),
            "all cells of the image hold the same number, 3");
}

TEST(ImageScores, ClippedHistogramsAreNoticed) {
  std::vector<float> bell, clipped;
  for (int k = 0; k < 20000; ++k) {
    double sum = 0.0;
    for (int j = 0; j < 6; ++j) sum += sampling::unit_double(sampling::hash(5, k, j));
    const double value = std::round(128.0 + 60.0 * (sum - 3.0));
    bell.push_back(static_cast<float>(value));
    clipped.push_back(static_cast<float>(std::min(value, 150.0)));
  }
  EXPECT_EQ(score_image(bell, {}).clipped_high, 0.0);
  EXPECT_EQ(score_image(bell, {}).clipped_low, 0.0);
  EXPECT_GT(score_image(clipped, {}).clipped_high, 0.2);
  EXPECT_EQ(score_image(clipped, {}).clipped_low, 0.0);
}

TEST(TextureMap, BrightPixelsTakeBrightCurves) {
  // The image has the scores -1 and 1, the curves (mean 0.4, deviation 0.2) stand at -1.5, -0.5, 0.5 and 1.5 / 1.118.
  const std::vector<radiometry::Spectrum> curves{
      radiometry::Spectrum::constant(0.1), radiometry::Spectrum::constant(0.3),
      radiometry::Spectrum::constant(0.5), radiometry::Spectrum::constant(0.7)};
  const SpectralRange range[] = {{0.6, 0.7}};
  const ImageScores image = score_image(std::vector<float>{50.0f, 250.0f}, {});
  const MapGrid grid{0.0, 1.0, 1.0, 1.0, 2, 1, Tiling::repeat, MapBy::position};
  const TextureMap texture({{grid, image.scores}}, CurveMatcher(range_means(curves, range), 1), 9);
  const auto reflectance = [&](double x) {
    const CurveMix mix = texture.at({x, 0.5});
    return (1.0 - mix.second_share) * curves[mix.first].at(0.65) +
           mix.second_share * curves[mix.second].at(0.65);
  };
  // Reflectance = mean of the curves + score x their standard deviation.
  EXPECT_NEAR(reflectance(0.5), 0.4 - std::sqrt(0.05), 1e-9);
  EXPECT_NEAR(reflectance(1.5), 0.4 + std::sqrt(0.05), 1e-9);
  EXPECT_NEAR(reflectance(101.5), 0.4 + std::sqrt(0.05), 1e-9);
}

TEST(TextureMap, NeedsAnImageForEachRange) {
  EXPECT_EQ(error_of([] {
              TextureMap({{kOneCell, {0.0f}}}, CurveMatcher({0.1, 0.2, 0.3, 0.1}, 2), 1);
            }),
            "a texture of 2 spectral ranges needs as many images: found 1");
}

}  // namespace
}  // namespace ifov::materials::test_texture_map
