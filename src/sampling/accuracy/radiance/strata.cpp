#include "sampling/accuracy/radiance/strata.h"

#include <numeric>

namespace ifov::sampling {

std::size_t Stratum::count() const {
  if (nets.size > 0) return std::accumulate(nets.accepted.begin(), nets.accepted.end(), std::size_t{0});
  double count = 0.0;
  for (const BlockSums& grid : rounds) count += grid.count();
  return static_cast<std::size_t>(count);
}

double SourcePixel::clutter_count() const {
  double count = 0.0;
  for (const ClutterRound& round : rounds) count += static_cast<double>(round.count());
  return count;
}

}  // namespace ifov::sampling
