#include "sensor/noise.h"

#include <algorithm>
#include <array>

#include "sampling/hash.h"
#include "sensor/detector/keyed_normals.h"

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
    keyed_normals(key, first, std::span(normal).first(count));
    for (std::size_t k = 0; k < count; ++k)
      values[first + k] =
          static_cast<float>(static_cast<double>(values[first + k]) + standard_deviation * normal[k]);
  }
}

}  // namespace ifov::sensor
