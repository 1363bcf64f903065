#include "atmosphere/gauss_nodes.h"

#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <stdexcept>

namespace ifov::atmosphere {
namespace {

GaussNodes solved(int count) {
  GaussNodes nodes{std::vector<double>(count), std::vector<double>(count)};
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    double slope = 0.0;
    for (int step = 0; step < 20; ++step) {
      double p = 1.0, previous = 0.0;
      for (int l = 0; l < count; ++l) {
        const double next = ((2.0 * l + 1.0) * x * p - l * previous) / (l + 1.0);
        previous = p;
        p = next;
      }
      slope = count * (x * p - previous) / (x * x - 1.0);
      const double change = p / slope;
      x -= change;
      if (std::abs(change) < 1e-15) break;
    }
    nodes.position[i] = 0.5 * (1.0 + x);
    nodes.weight[i] = 1.0 / ((1.0 - x * x) * slope * slope);
  }
  return nodes;
}

}  // namespace

GaussNodes gauss_nodes(int count) {
  if (count < 1) throw std::invalid_argument("a quadrature needs at least one node");
  // Columns of air ask for the same few counts for each wavelength.
  constexpr std::size_t kKept = 64;
  static std::array<std::once_flag, kKept> made;
  static std::array<GaussNodes, kKept> kept;
  const auto k = static_cast<std::size_t>(count);
  if (k >= kKept) return solved(count);
  std::call_once(made[k], [&] { kept[k] = solved(count); });
  return kept[k];
}

}  // namespace ifov::atmosphere
