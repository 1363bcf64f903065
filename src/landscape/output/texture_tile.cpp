#include "landscape/output/texture_tile.h"

#include <algorithm>
#include <cmath>

#include "landscape/shapes/random_stream.h"

namespace ifov::landscape {
namespace {

constexpr int kCells = 256;

/// Value noise on a lattice of `period` cells around the tile.
double periodic_noise(const RandomStream& random, double u, double v, int period) {
  const double x = u * period, y = v * period, fx = std::floor(x), fy = std::floor(y);
  const auto corner = [&](int dx, int dy) {
    return random.of(period, (static_cast<int>(fx) + dx) % period, (static_cast<int>(fy) + dy) % period)
        .unit(0);
  };
  const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double a = smooth(x - fx), b = smooth(y - fy);
  return (corner(0, 0) * (1.0 - a) + corner(1, 0) * a) * (1.0 - b) +
         (corner(0, 1) * (1.0 - a) + corner(1, 1) * a) * b;
}

/// Octaves from `first` to `last` lattice cells a tile; each weighs as much as `fall` of the one before.
double octaves(const RandomStream& random, double u, double v, int first, int last, double fall) {
  double sum = 0.0, weight = 1.0, total = 0.0;
  for (int period = first; period <= last; period *= 2, weight *= fall) {
    sum += weight * periodic_noise(random, u, v, period);
    total += weight;
  }
  return sum / total;
}

double brightness(Grain grain, double u, double v) {
  const RandomStream random(static_cast<std::uint64_t>(grain) + 31);
  switch (grain) {
    case Grain::turf: return octaves(random, u, v, 4, 128, 0.8);
    case Grain::aggregate: return octaves(random, u, v, 2, 128, 0.9);
    case Grain::slabs: {
      const double x = 4.0 * u, y = 4.0 * v;
      const bool joint = x - std::floor(x) < 0.016 || y - std::floor(y) < 0.016;
      const double shade = random.of(static_cast<int>(x), static_cast<int>(y)).unit(0);
      const double speckle = octaves(random, u, v, 8, 128, 0.8);
      return joint ? 0.2 * speckle : 0.25 + 0.4 * shade + 0.35 * speckle;
    }
    case Grain::weathering: {
      const double tile = random.of(static_cast<int>(16.0 * u), static_cast<int>(12.0 * v)).unit(0);
      return 0.45 * tile + 0.55 * octaves(random, u, v, 2, 32, 0.7);
    }
  }
  return 0.0;
}

}  // namespace

TextureTile texture_tile(Grain grain) {
  constexpr const char* kNames[] = {"turf", "aggregate", "slabs", "weathering"};
  constexpr double kSizes_m[] = {5.12, 10.24, 6.0, 5.12};
  const auto k = static_cast<std::size_t>(grain);
  TextureTile tile{kNames[k], kSizes_m[k], {}};
  tile.raster.width = tile.raster.height = kCells;
  tile.raster.bands = 1;
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column)
      tile.raster.values.push_back(static_cast<float>(
          std::clamp(255.0 * brightness(grain, (column + 0.5) / kCells, (row + 0.5) / kCells), 0.0, 255.0)));
  return tile;
}

}  // namespace ifov::landscape
