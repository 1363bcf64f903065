#include "atmosphere/gas/term_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ifov::atmosphere {
namespace {

constexpr int kMostIterations = 25;

/// Numbers sets from 0 without gaps.
void close_gaps(std::vector<std::size_t>& set, std::size_t count) {
  std::vector<std::size_t> number(count, 0);
  for (const std::size_t s : set) number[s] = 1;
  std::exclusive_scan(number.begin(), number.end(), number.begin(), std::size_t{0});
  for (std::size_t& s : set) s = number[s];
}

std::vector<std::size_t> pieces_of_equal_length(const std::vector<double>& features, std::size_t width,
                                                std::size_t points, std::size_t count) {
  std::vector<double> sum(points);
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t f = 0; f < width; ++f) sum[i] += features[i * width + f];
  std::vector<std::size_t> order(points);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sum[a] < sum[b]; });
  const double low = sum[order.front()], length = sum[order.back()] - low;
  std::vector<std::size_t> set(points, 0);
  if (!(length > 0.0)) return set;
  for (std::size_t i = 0; i < points; ++i)
    set[i] =
        std::min(count - 1, static_cast<std::size_t>(static_cast<double>(count) * (sum[i] - low) / length));
  return set;
}

}  // namespace

std::vector<std::size_t> term_sets(const std::vector<double>& share, const std::vector<double>& features,
                                   std::size_t width, std::size_t count) {
  const std::size_t points = share.size();
  std::vector<std::size_t> set = pieces_of_equal_length(features, width, points, count);
  std::vector<double> mean(count * width), weight(count);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    std::fill(mean.begin(), mean.end(), 0.0);
    std::fill(weight.begin(), weight.end(), 0.0);
    for (std::size_t i = 0; i < points; ++i) {
      weight[set[i]] += share[i];
      for (std::size_t f = 0; f < width; ++f) mean[set[i] * width + f] += share[i] * features[i * width + f];
    }
    for (std::size_t s = 0; s < count; ++s)
      for (std::size_t f = 0; f < width && weight[s] > 0.0; ++f) mean[s * width + f] /= weight[s];
    bool changed = false;
    for (std::size_t i = 0; i < points; ++i) {
      double least = std::numeric_limits<double>::infinity();
      std::size_t nearest = set[i];
      for (std::size_t s = 0; s < count; ++s) {
        if (!(weight[s] > 0.0)) continue;
        double distance = 0.0;
        for (std::size_t f = 0; f < width; ++f) {
          const double d = features[i * width + f] - mean[s * width + f];
          distance += d * d;
        }
        if (distance < least) least = distance, nearest = s;
      }
      changed = changed || nearest != set[i];
      set[i] = nearest;
    }
    if (!changed) break;
  }
  close_gaps(set, count);
  return set;
}

}  // namespace ifov::atmosphere
