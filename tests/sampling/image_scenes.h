#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "sampling/field.h"
#include "sampling/image/levels.h"
#include "sampling/random.h"
#include "sampling/tolerance.h"

namespace ifov::test {

/// A picture whose two levels and true pixels are known: bright and dark fields with an oblique border in some pixels, a ripple, and
/// path noise of a skew distribution (an exponential one), larger in the dark. Column 1 is column 0 in other units and with other
/// shares of the levels.
class TwoLevelField : public sampling::Field {
 public:
  static constexpr int kColumns = 2;
  double border_slope = 0.37, border_period_px = 3.0, ripple = 0.05, noise = 0.3;
  /// The second level is less by this share in every other stripe of two pixels, which neither materials nor the first level tell.
  double canyon = 0.0;
  /// Bright spots of this radius and radiance in the middle of every so manyth pixel, which nothing announces.
  double wire_width_px = 0.0, wire_radiance = 0.0;
  int wire_period = 7;
  /// Planted faults of levels(): what it makes of the second level, and of the first's variances.
  double rest_factor = 1.0;
  bool blind_to_wires = false;
  bool wrong_exponent =
      false;  ///< with many strata variances are told too low, as if they fell by one more power of the number

  int columns() const override { return kColumns; }
  void labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) labels[k] = label(points[k].x_px, points[k].y_px);
    counts_.primary += points.size();
  }
  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      labels[k] = label(requests[k].point.x_px, requests[k].point.y_px);
      for (int c = 0; c < kColumns; ++c)
        values[k * static_cast<std::size_t>(stride()) + static_cast<std::size_t>(c)] =
            static_cast<float>(direct(requests[k], c) + rest(requests[k], c));
    }
    counts_.primary += requests.size();
  }
  void levels(const sampling::LevelRequests& of, sampling::LevelSums& sums) override {
    const auto stride = static_cast<std::size_t>(this->stride());
    for (auto* rows : {&sums.direct, &sums.direct_variance, &sums.rest, &sums.rest_variance})
      rows->assign(of.counts.size() * stride, 0.0f);
    sums.labels.resize(of.requests.size());
    sampling::LevelAccumulator group(kColumns);
    std::size_t k = 0;
    float row[kColumns];
    for (std::size_t g = 0; g < of.counts.size(); ++g) {
      group.clear();
      for (std::uint32_t n = 0; n < of.counts[g]; ++n, ++k) {
        const sampling::PathRequest& request = of.requests[k];
        sums.labels[k] = label(request.point.x_px, request.point.y_px);
        for (int c = 0; c < kColumns; ++c) row[c] = static_cast<float>(direct(request, c, !blind_to_wires));
        group.add_direct(row);
        if (of.whole[k] == 0) continue;
        for (int c = 0; c < kColumns; ++c) row[c] = static_cast<float>(rest_factor * rest(request, c));
        group.add_rest(row);
      }
      group.take(&sums.direct[g * stride], &sums.direct_variance[g * stride], &sums.rest[g * stride],
                 &sums.rest_variance[g * stride]);
      for (int c = 0; c < kColumns && wrong_exponent; ++c)
        sums.direct_variance[g * stride + static_cast<std::size_t>(c)] *=
            std::min(1.0f, 8.0f / static_cast<float>(of.counts[g]));
    }
    counts_.primary += of.requests.size();
  }
  std::uint32_t material_of(sampling::Label label) const override {
    return static_cast<std::uint32_t>(label);
  }
  sampling::RayCounts counts() const override { return counts_; }

  /// Of a whole pixel, by a fine grid.
  double truth(int i, int j, int c, int n) const {
    double sum = 0.0;
    for (int b = 0; b < n; ++b)
      for (int a = 0; a < n; ++a) {
        const double x = i + (a + 0.5) / n, y = j + (b + 0.5) / n;
        sum += direct_at(x, y, c) + rest_mean(x, y, c);
      }
    return sum / (n * n);
  }

 private:
  bool bright(double x, double y) const {
    return std::fmod(x + border_slope * y + 100.0 * border_period_px, 2.0 * border_period_px) <
           border_period_px;
  }
  sampling::Label label(double x, double y) const { return bright(x, y) ? 1 : 0; }
  bool on_wire(double x, double y) const {
    if (wire_width_px <= 0.0) return false;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    return (i + 3 * j) % wire_period == 0 && std::abs(x - i - 0.413) < 0.5 * wire_width_px;
  }
  double direct_at(double x, double y, int c, bool wires = true) const {
    const double wave = 1.0 + ripple * std::sin(17.0 * x) * std::cos(13.0 * y);
    return (bright(x, y) ? (c == 0 ? 1.0 : 3.0) : (c == 0 ? 0.2 : 1.0)) * wave +
           (wires && on_wire(x, y) ? wire_radiance : 0.0);
  }
  double rest_mean(double x, double y, int c) const {
    const double lit = std::fmod(x + 100.0, 4.0) < 2.0 ? 1.0 : 1.0 - canyon;
    return (bright(x, y) ? 0.2 : 0.3) * (c == 0 ? 1.0 : 0.5) * lit;
  }
  double direct(const sampling::PathRequest& r, int c, bool wires = true) const {
    return direct_at(r.point.x_px, r.point.y_px, c, wires);
  }
  double rest(const sampling::PathRequest& r, int c) const {
    const double u =
        sampling::unit_double(sampling::hash(r.sequence, r.index));  // of many dimensions: no net helps
    return rest_mean(r.point.x_px, r.point.y_px, c) * (1.0 - noise - noise * std::log(1.0 - u));
  }

  sampling::RayCounts counts_;
};

/// A share of each column's mean.
class ShareOfMean final : public sampling::Tolerance {
 public:
  explicit ShareOfMean(double share) : share_(share) {}
  void limits(std::span<const double> mean, std::span<double> limit) const override {
    for (std::size_t c = 0; c < mean.size(); ++c) limit[c] = share_ * mean[c];
  }
  double confidence() const override { return 0.95; }

 private:
  double share_;
};

}  // namespace ifov::test
