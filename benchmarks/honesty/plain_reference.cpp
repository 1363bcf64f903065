#include "honesty/plain_reference.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace ifov::benchmarks {

namespace {

/// A generator of its own (splitmix64), so that no number is shared with the samplers.
class Generator {
 public:
  explicit Generator(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

 private:
  std::uint64_t state_;
};

/// A bound on the footprint's density: the largest value on a fine raster, with a margin for what lies
/// between.
double density_bound(const sampling::PixelFootprint& footprint) {
  constexpr int kCells = 256;
  const double half = footprint.half_width_px();
  double largest = 0.0;
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i)
      largest = std::max(largest, footprint.density(half * (2.0 * i / kCells - 1.0) * 0.999999,
                                                    half * (2.0 * j / kCells - 1.0) * 0.999999));
  return 1.02 * largest;
}

/// An offset distributed as the footprint's density, by rejection.
sampling::FocalPoint draw_offset(const sampling::PixelFootprint& footprint, double bound, Generator& random) {
  const double half = footprint.half_width_px();
  for (;;) {
    const double dx = half * (2.0 * random.uniform() - 1.0), dy = half * (2.0 * random.uniform() - 1.0);
    if (random.uniform() * bound < footprint.density(dx, dy)) return {dx, dy};
  }
}

struct Sums {
  std::vector<double> sum, sum_of_squares;
  std::int64_t count = 0;

  double mean(std::size_t c) const { return sum[c] / static_cast<double>(count); }
  double variance(std::size_t c) const {
    const double n = static_cast<double>(count);
    return std::max(0.0, (sum_of_squares[c] - sum[c] * sum[c] / n) / (n - 1.0));
  }
  double standard_error(std::size_t c) const { return std::sqrt(variance(c) / static_cast<double>(count)); }
};

}  // namespace

PlainMeans plain_means(const FieldFactory& make_field, int first_columns,
                       const sampling::PixelFootprint& footprint, sampling::Point2 shift_px,
                       std::span<const PixelIndex> pixels, std::span<const double> wanted_error,
                       std::int64_t least_paths, std::int64_t most_paths, std::uint64_t seed, int threads) {
  constexpr std::int64_t kBatch = 2048;
  const double bound = density_bound(footprint);
  const auto columns = static_cast<std::size_t>(first_columns);
  PlainMeans result;
  result.columns = first_columns;
  for (auto* values : {&result.mean, &result.standard_error, &result.spread})
    values->resize(pixels.size() * columns);

  parallel_for(static_cast<std::int64_t>(pixels.size()), threads, [&](std::int64_t k) {
    const auto p = static_cast<std::size_t>(k);
    const auto field = make_field();
    const auto stride = static_cast<std::size_t>(field->stride());
    Generator random(seed ^ (0x632be59bd9b4e019ull * (p + 1)));
    std::vector<sampling::PathRequest> requests;
    std::vector<sampling::Label> ignored;
    std::vector<float> values;
    Sums sums{std::vector<double>(columns), std::vector<double>(columns)};

    const auto precise = [&] {
      if (wanted_error.empty()) return false;
      for (std::size_t c = 0; c < columns; ++c)
        if (!(sums.standard_error(c) <= wanted_error[p * columns + c])) return false;
      return true;
    };
    while (sums.count < most_paths && !(sums.count >= least_paths && precise())) {
      const auto batch = static_cast<std::size_t>(std::min(kBatch, most_paths - sums.count));
      requests.resize(batch);
      ignored.resize(batch);
      values.assign(batch * stride, 0.0f);
      for (auto& request : requests) {
        const auto offset = draw_offset(footprint, bound, random);
        request = {
            {pixels[p].x + 0.5 + shift_px.x + offset.x_px, pixels[p].y + 0.5 + shift_px.y + offset.y_px},
            random.bits(),
            0};
      }
      field->values(requests, ignored, values);
      for (std::size_t n = 0; n < batch; ++n)
        for (std::size_t c = 0; c < columns; ++c) {
          const double value = static_cast<double>(values[n * stride + c]);
          sums.sum[c] += value;
          sums.sum_of_squares[c] += value * value;
        }
      sums.count += static_cast<std::int64_t>(batch);
    }
    for (std::size_t c = 0; c < columns; ++c) {
      result.mean[p * columns + c] = sums.mean(c);
      result.standard_error[p * columns + c] = sums.standard_error(c);
      result.spread[p * columns + c] = std::sqrt(sums.variance(c));
    }
  });
  return result;
}

}  // namespace ifov::benchmarks
