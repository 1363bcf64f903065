#include "sensor/detector/one_over_f.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/parallel.h"
#include "math/fft.h"
#include "sampling/hash.h"
#include "sensor/detector/detector.h"
#include "sensor/detector/keyed_normals.h"

namespace ifov::sensor {
namespace {

constexpr std::uint64_t kOneOverF = 0x312f66ull;

}  // namespace

std::vector<float> one_over_f_noise(const Detector& detector, std::uint64_t seed, int channel, int lines,
                                    int columns, int threads) {
  if (!(detector.one_over_f > 0.0) || !(detector.read_noise > 0.0)) return {};
  const math::Fft fft(2 * std::bit_ceil(static_cast<std::size_t>(std::max(lines, 1))));
  const std::size_t length = fft.length(), width = static_cast<std::size_t>(columns);
  std::vector<double> spread(length, 0.0);  // of the real and of the imaginary part
  for (std::size_t k = 1; k < length; ++k) {
    const double f = static_cast<double>(std::min(k, length - k)) / static_cast<double>(length);
    spread[k] = detector.read_noise * std::sqrt(detector.one_over_f / f / static_cast<double>(length));
  }
  std::vector<float> noise(static_cast<std::size_t>(lines) * width);
  const std::uint64_t key = sampling::hash(kOneOverF, seed, channel);
  // Two columns are the real and the imaginary part of one series.
  constexpr std::size_t kPairs = 8;
  const std::size_t pairs = (width + 1) / 2;
  parallel_for(static_cast<std::int64_t>((pairs + kPairs - 1) / kPairs), threads, [&](std::int64_t block) {
    std::vector<double> normal(2 * length);
    std::vector<std::complex<double>> series(length);
    const std::size_t first = static_cast<std::size_t>(block) * kPairs;
    for (std::size_t pair = first; pair < std::min(first + kPairs, pairs); ++pair) {
      keyed_normals(sampling::extend(key, pair), 0, normal);
      for (std::size_t k = 0; k < length; ++k)
        series[k] = {spread[k] * normal[2 * k], spread[k] * normal[2 * k + 1]};
      fft.transform(series);
      for (std::size_t line = 0; line < static_cast<std::size_t>(lines); ++line) {
        noise[line * width + 2 * pair] = static_cast<float>(series[line].real());
        if (2 * pair + 1 < width)
          noise[line * width + 2 * pair + 1] = static_cast<float>(series[line].imag());
      }
    }
  });
  return noise;
}

}  // namespace ifov::sensor
