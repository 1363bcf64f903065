#include "atmosphere/sensor/directions/kept_integrals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ifov::atmosphere {
namespace {

constexpr double kMostMoved = 0.25;

/// Values along one angle of a table, `stride` apart.
struct Line {
  std::span<const double> values;
  std::size_t first, stride;
  double at(std::size_t k) const { return values[first + stride * k]; }
};

/// Second derivative of the parabola through three values.
double second_derivative(const std::vector<double>& at, const Line& line, std::size_t k) {
  const double before = at[k] - at[k - 1], after = at[k + 1] - at[k];
  return 2.0 * ((line.at(k + 1) - line.at(k)) / after - (line.at(k) - line.at(k - 1)) / before) /
         (before + after);
}

/// Of a step, from those at its two ends.
double between(double low, double high) {
  if (!(low * high > 0.0)) return 0.0;
  const double mean = 0.5 * (low + high), most = 2.0 * std::min(std::abs(low), std::abs(high));
  return std::clamp(mean, -most, most);
}

/// At both ends of the angle the sky is symmetric (`mirrored`), or nothing is known.
void add_moves(const std::vector<double>& at, const Line& line, bool mirrored, std::span<double> moved) {
  const std::size_t last = at.size() - 1;
  if (last < 2) return;
  std::vector<double> curved(at.size(), 0.0);
  for (std::size_t k = 1; k < last; ++k) curved[k] = second_derivative(at, line, k);
  const auto end = [&](std::size_t k, std::size_t beside) {
    const double step = at[k] - at[beside];
    return mirrored ? 2.0 * (line.at(beside) - line.at(k)) / (step * step) : 0.0;
  };
  curved.front() = end(0, 1);
  curved.back() = end(last, last - 1);
  for (std::size_t k = 0; k <= last; ++k) {
    double lacking = 0.0, width = 0.0;
    for (const std::size_t low : {k - 1, k}) {
      if ((low == k && k == last) || (low != k && k == 0)) continue;
      const double step = at[low + 1] - at[low];
      lacking += step * step * step * between(curved[low], curved[low + 1]) / 12.0;
      width += step;
    }
    moved[line.first + line.stride * k] -= lacking / width;
  }
}

}  // namespace

void keep_integrals(const SkyDirections& directions, std::span<double> radiance) {
  const std::size_t zeniths = directions.zenith_rad.size(), azimuths = directions.azimuth_rad.size();
  std::vector<double> moved(radiance.size(), 0.0);
  for (std::size_t a = 0; a < azimuths; ++a)
    add_moves(directions.zenith_rad, {radiance, a, azimuths}, false, moved);
  for (std::size_t z = 0; z < zeniths; ++z)
    add_moves(directions.azimuth_rad, {radiance, z * azimuths, 1}, true, moved);
  for (std::size_t d = 0; d < radiance.size(); ++d) {
    const double most = kMostMoved * std::abs(radiance[d]);
    radiance[d] += std::clamp(moved[d], -most, most);
  }
}

}  // namespace ifov::atmosphere
