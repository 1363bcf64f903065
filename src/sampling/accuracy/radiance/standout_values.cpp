#include "sampling/accuracy/radiance/standout_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/borders/steering_columns.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/hash.h"

namespace ifov::sampling {

namespace {

/// What lies within so many standard deviations of a label's values is what many values are expected to come to.
constexpr double kExpected = 5.0;

constexpr std::uint64_t kStandoutKey = 0x7374616e64;

}  // namespace

void StandoutValues::ask(std::span<const FocalPoint> points, RayLedger& ledger, std::uint64_t seed) {
  const PixelRect& d = lattice_.domain();
  std::vector<std::pair<int, std::size_t>> of_pixel;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].x_px >= d.x0 && points[i].x_px < d.x1 && points[i].y_px >= d.y0 && points[i].y_px < d.y1)
      of_pixel.emplace_back(lattice_.pixel_at(points[i]), i);
  if (of_pixel.empty()) return;
  std::stable_sort(of_pixel.begin(), of_pixel.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<PathRequest> requests;
  first_.assign(static_cast<std::size_t>(d.count()) + 1, 0);
  for (const auto& [pixel, point] : of_pixel) {
    const std::size_t number = first_[static_cast<std::size_t>(pixel) + 1]++;
    requests.push_back({points[point],
                        hash(seed, kStandoutKey, d.x0 + pixel % d.width(), d.y0 + pixel / d.width()),
                        static_cast<std::uint32_t>(number)});
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  stride_ = static_cast<std::size_t>(ledger.field().stride());
  rows_.resize(requests.size() * stride_);
  std::vector<std::uint32_t> labels;
  ledger.first_values(requests, labels, rows_);
}

/// Beyond what differs about the vertex of the pixel that is most like the value, in allowed standard errors; `column`: where most.
double StandoutValues::beyond_nearest(int pixel, const float* value, const LabelSpread& spread,
                                      std::span<const double> inverse, int& column) const {
  const int k = lattice_.cells_per_pixel(), row = lattice_.columns() + 1;
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t vertex = 0;
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i <= k; ++i) {
      const std::size_t v = lattice_.first_vertex(pixel) + static_cast<std::size_t>(j * row + i);
      const float* there = values_.value(v);
      double farthest = 0.0;
      for (std::size_t c = 0; c < inverse.size() && farthest < nearest; ++c) {
        const double difference = static_cast<double>(value[c]) - static_cast<double>(there[c]);
        farthest = std::max(farthest, difference * difference * inverse[c]);
      }
      if (farthest < nearest) nearest = farthest, vertex = v;
    }
  double most = 0.0;
  for (std::size_t c = 0; c < inverse.size(); ++c) {
    const double difference =
                     std::abs(static_cast<double>(value[c]) - static_cast<double>(values_.value(vertex)[c])),
                 expected = kExpected * std::sqrt(spread.local(values_.labels[vertex], static_cast<int>(c))),
                 beyond = (difference - expected) * std::sqrt(inverse[c]);
    if (beyond > most) most = beyond, column = static_cast<int>(c);
  }
  return most;
}

void StandoutValues::judge(const LabelSpread& spread, const InverseSquares& allowed,
                           SteeringColumns& steering) {
  if (first_.empty()) return;
  apart_.assign(first_.size() - 1, 0.0);
  for (std::size_t p = 0; p < apart_.size(); ++p)
    for (std::size_t i = first_[p]; i < first_[p + 1]; ++i) {
      const std::span<const double> inverse = allowed(static_cast<int>(p));
      int column = 0;
      const double beyond = beyond_nearest(static_cast<int>(p), &rows_[i * stride_], spread, inverse, column);
      if (beyond > 1.0) steering.let_steer(column);
      apart_[p] = std::max(apart_[p], beyond);
    }
}

double StandoutValues::farthest_square(int pixel, int column, double mean) const {
  if (first_.empty()) return 0.0;
  double farthest = 0.0;
  const auto p = static_cast<std::size_t>(pixel);
  for (std::size_t i = first_[p]; i < first_[p + 1]; ++i) {
    const double distance = static_cast<double>(rows_[i * stride_ + static_cast<std::size_t>(column)]) - mean;
    farthest = std::max(farthest, distance * distance);
  }
  return farthest;
}

}  // namespace ifov::sampling
