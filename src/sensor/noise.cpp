#include "sensor/noise.h"

#include <algorithm>
#include <array>

#include "math/normal.h"
#include "sampling/hash.h"

namespace ifov::sensor {
namespace {

/// Beside other random numbers of the same seed.
constexpr std::uint64_t kNoise = 0x6e6f697365ull;

}  // namespace

void Noise::add(int line, int band, double standard_deviation, std::span<float> values) const {
  const std::uint64_t key = sampling::hash(kNoise, seed_, band, line);
  constexpr std::size_t kAtOnce = 256;
  std::array<double, kAtOnce> normal;
  for (std::size_t first = 0; first < values.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, values.size() - first);
    // The middles of 2^52 equal parts: never 0 and never 1.
    for (std::size_t k = 0; k < count; ++k)
      normal[k] =
          (static_cast<double>(static_cast<std::int64_t>(sampling::mix(key + first + k) >> 12)) + 0.5) *
          0x1p-52;
    math::normal_quantiles(std::span(normal).first(count));
    for (std::size_t k = 0; k < count; ++k)
      values[first + k] =
          static_cast<float>(static_cast<double>(values[first + k]) + standard_deviation * normal[k]);
  }
}

}  // namespace ifov::sensor
