#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "ifov/error.h"
#include "ifov/run_control.h"
#include "ifov/sampling.h"

namespace facade_test::test_sampling {

/// 3 on the left of a slanted line, 1 on its right, and beside it a number drawn at random.
class Halves : public ifov::FieldFunction {
 public:
  int columns() const override { return 2; }
  int random_numbers() const override { return 1; }
  void labels(std::span<const double> x, std::span<const double> y,
              std::span<std::uint64_t> labels) override {
    for (std::size_t k = 0; k < x.size(); ++k) labels[k] = is_left(x[k], y[k]) ? 7 : 9;
  }
  void values(std::span<const double> x, std::span<const double> y, std::span<const double> random,
              std::span<std::uint64_t> labels, std::span<double> values) override {
    this->labels(x, y, labels);
    for (std::size_t k = 0; k < x.size(); ++k) {
      values[2 * k] = labels[k] == 7 ? 3.0 : 1.0;
      values[2 * k + 1] = poison + random[k];
    }
  }
  double poison = 0.0;

 private:
  static bool is_left(double x, double y) { return x < 1.3 + 0.2 * y; }
};

TEST(Integration, MeansOfHalvesAndOfRandomNumbers) {
  Halves halves;
  const ifov::IntegratedImage image = ifov::integrate(halves, 3, 2, {.error = 0.02});
  ASSERT_EQ(image.mean.size(), 12u);
  // Pixel (1, 0): the line runs from 1.3 to 1.5, so that 0.4 of it are on the left; (1, 1): from 1.5 to 1.7.
  for (const auto& [pixel, left] : {std::pair{0, 1.0}, {1, 0.4}, {2, 0.0}, {3, 1.0}, {4, 0.6}, {5, 0.0}}) {
    EXPECT_NEAR(image.mean[2 * pixel], 1.0 + 2.0 * left, image.half_width[2 * pixel] + 1e-6) << pixel;
    EXPECT_NEAR(image.mean[2 * pixel + 1], 0.5, 1.5 * image.half_width[2 * pixel + 1]) << pixel;
    EXPECT_LE(image.half_width[2 * pixel], 0.02f);
    EXPECT_EQ(image.reasons[pixel], 0);
    EXPECT_GT(image.samples[pixel], 8u);
  }
}

TEST(Integration, RefusesWhatMakesNoSense) {
  Halves halves;
  EXPECT_THROW(ifov::integrate(halves, 0, 2, {}), std::invalid_argument);
  EXPECT_THROW(ifov::integrate(halves, 2, 2, {.error = -1.0}), std::invalid_argument);
  EXPECT_THROW(ifov::integrate(halves, 2, 2, {.confidence = 1.0}), std::invalid_argument);
  halves.poison = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ifov::integrate(halves, 2, 2, {}), std::invalid_argument);
}

TEST(Integration, IsCancelled) {
  Halves halves;
  ifov::CancelToken token;
  token.cancel();
  EXPECT_THROW(ifov::integrate(halves, 2, 2, {.cancel = &token}), ifov::Cancelled);
}

}  // namespace facade_test::test_sampling
