#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sampling/hash.h"
#include "sampling/random.h"
#include "support/statistics.h"

namespace ifov::sampling::test_random {
namespace {

double uniformity_p_value(double (*draw)(int)) {
  constexpr int kCount = 200000, kCells = 100;
  std::vector<double> observed(kCells, 0.0);
  for (int k = 0; k < kCount; ++k) observed[static_cast<std::size_t>(draw(k) * kCells)] += 1.0;
  return test::chi_square_test(observed, std::vector<double>(kCells, double(kCount) / kCells));
}

TEST(Hash, IsSplitmix64) {
  // First outputs of splitmix64 seeded with 1234567 (Vigna's reference program).
  constexpr std::uint64_t kGamma = 0x9e3779b97f4a7c15ull;
  EXPECT_EQ(mix(1234567u), 6457827717110365317ull);
  EXPECT_EQ(mix(1234567u + kGamma), 3203168211198807973ull);
}

TEST(Hash, DependsOnOrderAndNumberOfWords) {
  EXPECT_NE(hash(1, 2), hash(2, 1));
  EXPECT_NE(hash(1, 0), hash(1));
  EXPECT_NE(hash(0, 1), hash(1, 0));
  EXPECT_EQ(hash(1, 2, 3), hash(1ull, 2ull, 3ull));
}

TEST(Hash, EveryInputBitMovesHalfTheOutput) {
  for (int word = 0; word < 3; ++word)
    for (int bit = 0; bit < 64; ++bit) {
      double flipped = 0.0;
      for (std::uint64_t k = 0; k < 200; ++k) {
        std::uint64_t w[3] = {k, k * 7 + 1, k * 13 + 5};
        const std::uint64_t before = hash(w[0], w[1], w[2]);
        w[word] ^= 1ull << bit;
        flipped += __builtin_popcountll(before ^ hash(w[0], w[1], w[2]));
      }
      EXPECT_NEAR(flipped / 200.0, 32.0, 1.6) << "word " << word << " bit " << bit;
    }
}

TEST(UnitDouble, IsUniformOverConsecutiveKeys) {
  EXPECT_GT(uniformity_p_value([](int k) { return unit_double(hash(7, k)); }), 1e-4);
  EXPECT_GT(uniformity_p_value([](int k) { return unit_double(static_cast<std::uint64_t>(k)); }), 1e-4);
}

TEST(UnitDouble, SkewIsCaught) {
  EXPECT_LT(uniformity_p_value([](int k) { return std::pow(unit_double(hash(7, k)), 1.05); }), 1e-6);
}

}  // namespace
}  // namespace ifov::sampling::test_random
