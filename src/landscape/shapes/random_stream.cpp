#include "landscape/shapes/random_stream.h"

#include <cmath>

namespace ifov::landscape {
namespace {

double smooth_step(double t) { return t * t * (3.0 - 2.0 * t); }

double value_noise(const RandomStream& random, double x, double y) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy);
  const double u = smooth_step(x - fx), v = smooth_step(y - fy);
  const auto corner = [&](std::int64_t dx, std::int64_t dy) { return random.of(ix + dx, iy + dy).unit(0); };
  const double low = corner(0, 0) * (1.0 - u) + corner(1, 0) * u;
  const double high = corner(0, 1) * (1.0 - u) + corner(1, 1) * u;
  return low * (1.0 - v) + high * v;
}

}  // namespace

double fractal_noise(const RandomStream& random, double x_m, double y_m, double scale_m, int octaves) {
  double sum = 0.0, weight = 1.0, total = 0.0;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * value_noise(random.of(octave), x_m / scale_m, y_m / scale_m);
    total += weight;
    weight *= 0.5;
    scale_m *= 0.5;
  }
  return sum / total;
}

}  // namespace ifov::landscape
