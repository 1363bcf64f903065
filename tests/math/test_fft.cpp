#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "math/fft.h"

namespace ifov::math::test_fft {
namespace {

using Series = std::vector<std::complex<double>>;

Series some(std::size_t length) {
  Series values;
  for (std::size_t k = 0; k < length; ++k) {
    const auto x = static_cast<double>(k);
    values.emplace_back(std::sin(1.7 * x + 0.2), std::cos(x * x));
  }
  return values;
}

/// By the definition.
Series summed(const Series& x) {
  Series result(x.size());
  for (std::size_t n = 0; n < x.size(); ++n)
    for (std::size_t k = 0; k < x.size(); ++k)
      result[n] += x[k] * std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(k * n % x.size()) /
                                              static_cast<double>(x.size()));
  return result;
}

TEST(Fft, IsTheSum) {
  for (const std::size_t length : {1u, 2u, 4u, 8u, 64u, 256u}) {
    const Series expected = summed(some(length));
    Series found = some(length);
    Fft(length).transform(found);
    for (std::size_t n = 0; n < length; ++n) EXPECT_LT(std::abs(found[n] - expected[n]), 1e-11 * 256) << n;
  }
}

TEST(Fft, TakesPowersOfTwo) {
  EXPECT_THROW(Fft(0), InputError);
  EXPECT_THROW(Fft(12), InputError);
}

}  // namespace
}  // namespace ifov::math::test_fft
