#include "io/product_parts/cube_scan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/product_parts/turned_bands.h"
#include "sampling/intervals/bounded_error.h"

namespace ifov::io {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kLanes = 8;

template <class Value>
using Lanes = std::array<Value, kLanes>;

double sum_of(const Lanes<double>& lane) {
  return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

bool all_finite(std::span<const float> values) {
  std::uint32_t others = 0;
  for (const float value : values) others += value - value == 0.0f ? 0u : 1u;
  return others == 0;
}

std::optional<HalfWidthParts> parts_of(const std::optional<render::AtmosphereHalfWidth>& air,
                                       const ChannelStatistics& s, const sampling::BoundedError& joint) {
  if (!air || !std::isfinite(s.mean) || !std::isfinite(s.mean_half_width)) return std::nullopt;
  HalfWidthParts parts;
  parts.nodes = air->of_nodes(s.mean);
  parts.air = air->of(s.mean) - parts.nodes;
  parts.model = air->in_interval(s.mean);
  parts.sampling = joint.random(s.mean_half_width, air->all_of(s.mean));
  return parts;
}

}  // namespace

void BandFigures::add(std::span<const float> values) {
  total_ += values.size();
  std::size_t first = 0;
  if (finite_ == 0) {
    while (first < values.size() && !std::isfinite(values[first])) ++first;
    if (first == values.size()) return;
    offset_ = values[first];
  }

  // Almost all lines are finite throughout; the loops below are then without a condition.
  if (all_finite(values.subspan(first))) return add_finite(values.subspan(first));
  for (std::size_t i = first; i < values.size(); ++i)
    if (std::isfinite(values[i])) add_finite(values.subspan(i, 1));
}

void BandFigures::add_finite(std::span<const float> values) {
  Lanes<double> sum{}, squares{};
  Lanes<float> low, high;
  low.fill(low_);
  high.fill(high_);
  const std::size_t whole = values.size() / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float value = values[i + lane];
      const double v = static_cast<double>(value) - offset_;
      sum[lane] += v;
      squares[lane] += v * v;
      low[lane] = value < low[lane] ? value : low[lane];
      high[lane] = value > high[lane] ? value : high[lane];
    }
  sum_ += sum_of(sum);
  squares_ += sum_of(squares);
  low_ = *std::min_element(low.begin(), low.end());
  high_ = *std::max_element(high.begin(), high.end());
  for (const float value : values.subspan(whole)) {
    const double v = static_cast<double>(value) - offset_;
    sum_ += v;
    squares_ += v * v;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  finite_ += values.size();
}

double BandFigures::minimum() const { return finite_ > 0 ? static_cast<double>(low_) : kNone; }
double BandFigures::maximum() const { return finite_ > 0 ? static_cast<double>(high_) : kNone; }
double BandFigures::mean() const {
  return finite_ > 0 ? offset_ + sum_ / static_cast<double>(finite_) : kNone;
}
double BandFigures::standard_deviation() const {
  if (finite_ == 0) return kNone;
  const double n = static_cast<double>(finite_);
  return std::sqrt(std::max(0.0, squares_ / n - sum_ / n * (sum_ / n)));
}

void CubeScan::take(const std::byte* line, std::size_t stride_bytes) {
  const auto width = static_cast<std::size_t>(width_), bands = static_cast<std::size_t>(bands_);
  const bool by_pixel = interleave_ == EnviInterleave::bip;
  if (by_pixel) {
    sum_.update(line, value_bytes_ * width * bands);
    if (!figures_.empty()) {
      turned_.resize(value_bytes_ * width * bands);
      turn_bands(line, width, bands, turned_.data(), width, value_bytes_);
      line = turned_.data(), stride_bytes = value_bytes_ * width;
    }
  }
  for (std::size_t band = 0; band < bands; ++band) {
    const std::byte* row = line + band * stride_bytes;
    if (!by_pixel && interleave_ != EnviInterleave::bsq) sum_.update(row, value_bytes_ * width);
    if (!figures_.empty()) figures_[band].add({reinterpret_cast<const float*>(row), width});
  }
  ++lines_;
}

std::vector<ChannelStatistics> channel_statistics(const render::ImageInfo& image, const CubeScan& radiance,
                                                  const CubeScan* half_width, double confidence) {
  std::vector<ChannelStatistics> result;
  const sampling::BoundedError joint(confidence);
  for (std::size_t band = 0; band < radiance.figures().size(); ++band) {
    const BandFigures& values = radiance.figures()[band];
    const BandFigures widths = half_width != nullptr ? half_width->figures()[band] : BandFigures{};
    ChannelStatistics s;
    s.minimum = values.minimum();
    s.maximum = values.maximum();
    s.mean = values.mean();
    s.standard_deviation = values.standard_deviation();
    s.mean_half_width = widths.mean();
    s.largest_half_width = widths.maximum();
    s.not_finite = values.not_finite();
    s.parts = parts_of(image.channels[band].air, s, joint);
    result.push_back(s);
  }
  return result;
}

}  // namespace ifov::io
