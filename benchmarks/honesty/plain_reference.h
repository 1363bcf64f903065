#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "sampling/field.h"
#include "sampling/pixel_footprint.h"
#include "sampling/random.h"

namespace ifov::benchmarks {

/// Makes one field per thread.
using FieldFactory = std::function<std::unique_ptr<sampling::Field>()>;

struct PixelIndex {
  int x = 0, y = 0;
};

/// Per pixel and column, [pixel * columns + column].
struct PlainMeans {
  int columns = 0;
  std::vector<double> mean;
  std::vector<double> standard_error;
  std::vector<double> spread;  ///< standard deviation of single paths
};

/// The mean radiance over the footprint of each pixel by plain Monte Carlo: points drawn independently from
/// the footprint's density about a place `shift_px` from the pixel's centre, one path each with random numbers of its own; no labels, no strata, no memory of
/// edges. The first `columns` of the field's are looked at. This shares nothing with the samplers but the field's radiance itself. Each pixel takes at least
/// `least_paths` and goes on until the standard error of every column is at most `wanted_error` (same layout;
/// empty: never) or `most_paths` are spent.
PlainMeans plain_means(const FieldFactory& make_field, int columns, const sampling::PixelFootprint& footprint,
                       sampling::Point2 shift_px, std::span<const PixelIndex> pixels,
                       std::span<const double> wanted_error, std::int64_t least_paths,
                       std::int64_t most_paths, std::uint64_t seed, int threads);

}  // namespace ifov::benchmarks
