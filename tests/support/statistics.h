#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "math/chi_square.h"
#include "math/vec3.h"
#include "sampling/random.h"
#include "sampling/warp.h"

/// Statistical tests for samplers: chi-square against a density, and the round trip through an inverse.
namespace ifov::test {

using math::chi_square_p_value;
using math::chi_square_test;
using math::upper_gamma;

/// p-value of directions sample(u) against density(direction) per steradian. Cells are equal in cosine and
/// azimuth about `axis`, from cos_low to 1; `count` random u from `seed`.
template <class Sample, class Density>
double direction_test(math::Vec3 axis, double cos_low, int count, std::uint64_t seed, Sample sample,
                      Density density) {
  constexpr int kRows = 8, kColumns = 16, kFine = 12;
  const sampling::TangentFrame frame(axis);
  std::vector<double> observed(kRows * kColumns, 0.0), expected(kRows * kColumns, 0.0);
  for (int k = 0; k < count; ++k) {
    const sampling::Point2 u{sampling::unit_double(sampling::hash(seed, k, 0)),
                             sampling::unit_double(sampling::hash(seed, k, 1))};
    const math::Vec3 local = frame.to_local(sample(u));
    const int row = static_cast<int>(std::floor((local.z - cos_low) / (1.0 - cos_low) * kRows));
    const double turn = std::atan2(local.y, local.x) / (2.0 * std::numbers::pi) + 0.5;
    const int column = std::min(kColumns - 1, static_cast<int>(turn * kColumns));
    if (row < 0) return 0.0;
    observed[static_cast<std::size_t>(std::min(row, kRows - 1) * kColumns + column)] += 1.0;
  }
  const double cell_sr = (1.0 - cos_low) * 2.0 * std::numbers::pi / (kRows * kColumns * kFine * kFine);
  double total = 0.0;
  for (int row = 0; row < kRows * kFine; ++row)
    for (int column = 0; column < kColumns * kFine; ++column) {
      const double z = cos_low + (1.0 - cos_low) * (row + 0.5) / (kRows * kFine);
      const double angle = 2.0 * std::numbers::pi * ((column + 0.5) / (kColumns * kFine) - 0.5);
      const double r = std::sqrt(1.0 - z * z);
      const double part =
          cell_sr * density(frame.to_world({r * std::cos(angle), r * std::sin(angle), z})) * count;
      expected[static_cast<std::size_t>(row / kFine * kColumns + column / kFine)] += part;
      total += part;
    }
  // A density that does not integrate to 1 is as wrong as one of the wrong shape.
  if (std::abs(total / count - 1.0) > 0.01) return 0.0;
  for (double& e : expected) e *= count / total;
  return chi_square_test(observed, expected);
}

/// Largest distance between u and inverse(sample(u)) over `count` random points.
template <class Sample, class Inverse>
double round_trip_error(int count, std::uint64_t seed, Sample sample, Inverse inverse) {
  double worst = 0.0;
  for (int k = 0; k < count; ++k) {
    const sampling::Point2 u{sampling::unit_double(sampling::hash(seed, k, 0)),
                             sampling::unit_double(sampling::hash(seed, k, 1))};
    const sampling::Point2 back = inverse(sample(u));
    worst = std::max({worst, std::abs(back.x - u.x), std::abs(back.y - u.y)});
  }
  return worst;
}

}  // namespace ifov::test
