#include "sampling/accuracy/radiance/standout_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/borders/steering_columns.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/hash.h"
#include "sampling/tile.h"

namespace ifov::sampling {

namespace {

/// What lies within so many standard deviations of a label's values is what many values are expected to come to.
constexpr double kExpected = 5.0;

/// A thin shadow that takes more of a pixel than this, in allowed standard errors, matters: less is within the least half-width.
constexpr double kShadowMatters = 0.2;
/// One that takes more than this asks for values that would show it: so many times what lies between light and dark.
constexpr double kShadowAsks = 0.5, kShadowValues = 1.72;

constexpr std::uint64_t kStandoutKey = 0x7374616e64, kShadowKey = 0x736861646f77;

}  // namespace

void StandoutValues::ask(std::span<const FocalPoint> points, std::span<const ThinShadow> shadows,
                         RayLedger& ledger, std::uint64_t seed) {
  const PixelRect& d = lattice_.domain();
  const auto is_within = [&](const FocalPoint& at) {
    return at.x_px >= d.x0 && at.x_px < d.x1 && at.y_px >= d.y0 && at.y_px < d.y1;
  };
  struct Known {
    int pixel;
    FocalPoint point;
    float share;
  };
  std::vector<Known> known;
  for (const FocalPoint& point : points)
    if (is_within(point)) known.push_back({lattice_.pixel_at(point), point, 0.0f});
  std::map<int, Known> darkest;
  for (const ThinShadow& shadow : shadows) {
    if (!is_within(shadow.point)) continue;
    const int pixel = lattice_.pixel_at(shadow.point);
    const auto [at, fresh] = darkest.try_emplace(pixel, Known{pixel, shadow.point, shadow.share});
    if (!fresh && shadow.share > at->second.share) at->second = {pixel, shadow.point, shadow.share};
  }
  stride_ = static_cast<std::size_t>(ledger.field().stride());
  std::vector<PathRequest> requests;
  for (const auto& [pixel, shadow] : darkest)
    requests.push_back(
        {shadow.point, hash(seed, kShadowKey, d.x0 + pixel % d.width(), d.y0 + pixel / d.width()), 0});
  std::vector<float> dark(requests.size() * stride_);
  if (!requests.empty() && ledger.field().values_in_shadow(requests, dark))
    for (const auto& [pixel, shadow] : darkest) known.push_back(shadow);
  if (known.empty()) return;
  std::stable_sort(known.begin(), known.end(),
                   [](const Known& a, const Known& b) { return a.pixel < b.pixel; });

  requests.clear();
  first_.assign(static_cast<std::size_t>(d.count()) + 1, 0);
  std::vector<std::size_t> row;  // of each request
  for (const Known& one : known) {
    const std::size_t number = first_[static_cast<std::size_t>(one.pixel) + 1]++;
    if (one.share == 0.0f) {
      row.push_back(shares_.size());
      requests.push_back(
          {one.point, hash(seed, kStandoutKey, d.x0 + one.pixel % d.width(), d.y0 + one.pixel / d.width()),
           static_cast<std::uint32_t>(number)});
    }
    shares_.push_back(one.share);
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  rows_.resize(shares_.size() * stride_);
  std::vector<float> values(requests.size() * stride_);
  std::vector<std::uint32_t> labels;
  if (!requests.empty()) ledger.first_values(requests, labels, values);
  const auto put = [&](const std::vector<float>& from, std::size_t number, std::size_t at) {
    std::copy_n(&from[number * stride_], stride_, &rows_[at * stride_]);
  };
  for (std::size_t k = 0; k < row.size(); ++k) put(values, k, row[k]);
  std::size_t shadow = 0;
  for (std::size_t k = 0; k < shares_.size(); ++k)
    if (shares_[k] > 0.0f) put(dark, shadow++, k);
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

/// What a thin shadow may take from a pixel, as standouts are told: above 1 it matters.
double StandoutValues::shadow_apart(int pixel, std::size_t row, std::span<const double> inverse,
                                    int& column) const {
  const int k = lattice_.cells_per_pixel(), across = lattice_.columns() + 1;
  double most = 0.0;
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i <= k; ++i) {
      const float* lit =
          values_.value(lattice_.first_vertex(pixel) + static_cast<std::size_t>(j * across + i));
      for (std::size_t c = 0; c < inverse.size(); ++c) {
        const double difference =
            std::abs(static_cast<double>(lit[c]) - static_cast<double>(rows_[row * stride_ + c])) *
            std::sqrt(inverse[c]);
        if (difference > most) most = difference, column = static_cast<int>(c);
      }
    }
  const double taken = most * static_cast<double>(shares_[row]);
  return taken > kShadowAsks ? kShadowValues * most : taken / kShadowMatters;
}

void StandoutValues::judge(const LabelSpread& spread, const InverseSquares& allowed,
                           SteeringColumns& steering) {
  if (first_.empty()) return;
  apart_.assign(first_.size() - 1, 0.0);
  for (std::size_t p = 0; p < apart_.size(); ++p)
    for (std::size_t i = first_[p]; i < first_[p + 1]; ++i) {
      const std::span<const double> inverse = allowed(static_cast<int>(p));
      int column = 0;
      const double beyond = shares_[i] > 0.0f ? shadow_apart(static_cast<int>(p), i, inverse, column)
                                              : beyond_nearest(static_cast<int>(p), &rows_[i * stride_],
                                                               spread, inverse, column);
      if (beyond > 1.0) steering.let_steer(column);
      apart_[p] = std::max(apart_[p], beyond);
    }
}

double StandoutValues::farthest_square(int pixel, int column, double mean, double times) const {
  if (first_.empty()) return 0.0;
  double farthest = 0.0;
  const auto p = static_cast<std::size_t>(pixel);
  for (std::size_t i = first_[p]; i < first_[p + 1]; ++i) {
    const double distance = static_cast<double>(rows_[i * stride_ + static_cast<std::size_t>(column)]) - mean;
    const double counts = shares_[i] > 0.0f ? std::min(1.0, static_cast<double>(shares_[i]) * times) : 1.0;
    farthest = std::max(farthest, counts * counts * distance * distance);
  }
  return farthest;
}

}  // namespace ifov::sampling
