#include "sampling/accuracy/detection.h"

#include <algorithm>
#include <cmath>

namespace ifov::sampling {

namespace {

/// Places of the square, by the R2 sequence (Roberts 2018: powers of the inverse of the plastic number), which is in
/// step with no grid.
constexpr int kPositions = 48;
constexpr double kStepX = 0.7548776662466927, kStepY = 0.5698402909980532;

/// Shares of a grid's cells that an interval covers, along one axis.
void cover(double from, double length, int cells, std::vector<double>& shares) {
  shares.clear();
  const double low = from * cells, high = (from + length) * cells;
  for (double cell = std::floor(low); cell < high; cell += 1.0)
    shares.push_back(std::min(high, cell + 1.0) - std::max(low, cell));
}

}  // namespace

double probability_missed(const RandomRays& rays, double area) {
  const double side = std::sqrt(area);
  double sum = 0.0;
  std::vector<double> x, y;
  for (int k = 0; k < kPositions; ++k) {
    const double u = std::fmod((k + 0.5) * kStepX, 1.0), v = std::fmod((k + 0.5) * kStepY, 1.0);
    double missed = 1.0;
    for (const GridSides& cells : rays.grids) {
      cover(u, side, cells.columns, x);
      cover(v, side, cells.rows, y);
      for (const double sx : x)
        for (const double sy : y) missed *= std::max(0.0, 1.0 - sx * sy);
      if (missed == 0.0) break;
    }
    sum += missed;
  }
  return sum / kPositions * std::pow(1.0 - std::min(1.0, area), rays.independent);
}

float Detection::missable_fraction(const RandomRays& rays) {
  constexpr double kMissed = 0.05;
  constexpr double kNarrow = 1e-3;
  const auto known = known_.find(rays);
  if (known != known_.end()) return known->second;
  double low = 0.0, high = 1.0;
  while (high - low > kNarrow * high) {
    const double middle = 0.5 * (low + high);
    (probability_missed(rays, middle) > kMissed ? low : high) = middle;
  }
  return known_[rays] = static_cast<float>(high);
}

}  // namespace ifov::sampling
