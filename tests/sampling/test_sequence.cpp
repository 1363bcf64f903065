#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "sampling/sequence.h"
#include "support/statistics.h"

namespace ifov::sampling::test_sequence {
namespace {

/// Whether every elementary interval of area 2^-m holds exactly one of the 2^m points from `first` on.
template <class Draw>
bool is_net(std::uint32_t first, int m, Draw draw) {
  const std::uint32_t count = 1u << m;
  for (int split = 0; split <= m; ++split) {
    std::set<std::uint64_t> cells;
    for (std::uint32_t k = 0; k < count; ++k) {
      const Point2 p = draw(first + k);
      const auto column = static_cast<std::uint64_t>(std::ldexp(p.x, split));
      const auto row = static_cast<std::uint64_t>(std::ldexp(p.y, m - split));
      cells.insert(column << 32 | row);
    }
    if (cells.size() != count) return false;
  }
  return true;
}

TEST(Sequence, SecondSobolDimensionMatchesTheDirectionNumbers) {
  for (std::uint32_t index : {0u, 1u, 2u, 3u, 5u, 100u, 65537u, 0xdeadbeefu}) {
    std::uint32_t expected = 0, direction = 0x80000000u;
    for (std::uint32_t i = index; i != 0; i >>= 1, direction ^= direction >> 1)
      if (i & 1u) expected ^= direction;
    EXPECT_EQ(detail::reverse_bits(detail::sobol_second_reversed(index)), expected) << index;
  }
}

TEST(Sequence, EveryAlignedRunIsANet) {
  for (std::uint64_t key = 0; key < 20; ++key)
    for (std::uint32_t pair : {0u, 1u, 7u})
      for (int m : {1, 4, 8})
        for (std::uint32_t run : {0u, 1u, 5u})
          EXPECT_TRUE(is_net(run << m, m, [&](std::uint32_t i) { return sequence_point(key, i, pair); }))
              << "key " << key << " pair " << pair << " m " << m << " run " << run;
}

TEST(Sequence, RandomPointsAreNoNet) {
  EXPECT_FALSE(is_net(0, 4, [](std::uint32_t i) {
    return Point2{unit_double(hash(1, i, 0)), unit_double(hash(1, i, 1))};
  }));
}

TEST(Sequence, EachElementIsUniformOverKeys) {
  for (std::uint32_t index : {0u, 1u, 77u}) {
    std::vector<double> observed(64, 0.0);
    for (std::uint64_t key = 0; key < 20000; ++key) {
      const Point2 p = sequence_point(hash(key), index, 3);
      observed[static_cast<std::size_t>(p.x * 8) * 8 + static_cast<std::size_t>(p.y * 8)] += 1.0;
    }
    EXPECT_GT(test::chi_square_test(observed, std::vector<double>(64, 20000.0 / 64)), 1e-4);
  }
}

// Padding must not tie pairs to one another: the x of two pairs, over one long run, fill their square evenly.
double pair_p_value(std::uint32_t first_pair, std::uint32_t second_pair) {
  std::vector<double> observed(64, 0.0);
  for (std::uint64_t key = 0; key < 500; ++key)
    for (std::uint32_t index = 0; index < 16; ++index) {
      const double a = sequence_point(hash(key), index, first_pair).x;
      const double b = sequence_point(hash(key), index, second_pair).x;
      observed[static_cast<std::size_t>(a * 8) * 8 + static_cast<std::size_t>(b * 8)] += 1.0;
    }
  return test::chi_square_test(observed, std::vector<double>(64, 8000.0 / 64));
}

TEST(Sequence, PairsAreIndependent) { EXPECT_GT(pair_p_value(0, 1), 1e-4); }
TEST(Sequence, PairTiedToItselfIsCaught) { EXPECT_LT(pair_p_value(2, 2), 1e-6); }

TEST(Sequence, IntegratesAStepBetterThanRandomPoints) {
  double net = 0.0, random = 0.0;
  const auto inside = [](Point2 p) { return p.x * p.x + p.y * p.y < 0.5 ? 1.0 : 0.0; };
  const double truth = 0.5 * std::acos(-1.0) / 4.0;
  for (std::uint64_t key = 0; key < 200; ++key) {
    double a = 0.0, b = 0.0;
    for (std::uint32_t i = 0; i < 256; ++i) {
      a += inside(sequence_point(hash(key), i, 0)) / 256.0;
      b += inside({unit_double(hash(key, i, 0)), unit_double(hash(key, i, 1))}) / 256.0;
    }
    net += (a - truth) * (a - truth) / 200.0;
    random += (b - truth) * (b - truth) / 200.0;
  }
  EXPECT_LT(std::sqrt(net), 0.4 * std::sqrt(random));
}

TEST(Halton, FirstPoints) {
  const double x[] = {1 / 2.0, 1 / 4.0, 3 / 4.0, 1 / 8.0, 5 / 8.0};
  const double y[] = {1 / 3.0, 2 / 3.0, 1 / 9.0, 4 / 9.0, 7 / 9.0};
  for (std::uint32_t i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(halton_point(i).x, x[i]);
    EXPECT_DOUBLE_EQ(halton_point(i).y, y[i]);
  }
}

}  // namespace
}  // namespace ifov::sampling::test_sequence
