#include "sampling/image/like_pixels.h"

#include <algorithm>
#include <cmath>

namespace ifov::sampling {

namespace {

/// Squared differences of shares, and squared pixels, over which what a pixel tells of another falls to 1/e.
constexpr double kShareScale = 0.1, kDistanceScale = 12.0;
constexpr float kLeastWeight = 0.01f;
/// The prediction counts as so many pixels that are just like it, and what is known before as so many whose differences are told.
constexpr float kPredictionWeight = 1.0f;
constexpr float kPriorPixels = 2.0f;
/// How much any pixel of the block tells of how much a pixel differs, beside those that show the same, which tell 1.
constexpr float kAnyPixel = 0.05f;
/// However alike pixels seem, they differ by this share of their means' variance: what the block tells of it is not exact.
constexpr float kLeastBetween = 0.2f;

double difference(const std::map<std::uint32_t, double>& a, const std::map<std::uint32_t, double>& b) {
  double sum = 0.0;
  for (const auto& [material, share] : a) {
    const auto other = b.find(material);
    const double d = share - (other == b.end() ? 0.0 : other->second);
    sum += d * d;
  }
  for (const auto& [material, share] : b)
    if (!a.contains(material)) sum += share * share;
  return sum;
}

}  // namespace

LikePixels::LikePixels(std::span<const Place> places, std::span<const std::map<std::uint32_t, double>> shares)
    : size_(places.size()), likeness_(size_ * size_, 1.0f), weight_(size_ * size_, 0.0f) {
  for (std::size_t p = 0; p < size_; ++p)
    for (std::size_t q = 0; q < p; ++q) {
      const double x = places[p].i - places[q].i, y = places[p].j - places[q].j;
      const auto likeness = static_cast<float>(std::exp(-difference(shares[p], shares[q]) / kShareScale)),
                 weight = likeness * static_cast<float>(std::exp(-(x * x + y * y) / kDistanceScale));
      likeness_[p * size_ + q] = likeness_[q * size_ + p] = likeness;
      if (weight >= kLeastWeight) weight_[p * size_ + q] = weight_[q * size_ + p] = weight;
    }
}

std::vector<double> LikePixels::smoothed(std::span<const double> values,
                                         std::span<const double> otherwise) const {
  std::vector<double> result(size_);
  for (std::size_t p = 0; p < size_; ++p) {
    double sum = otherwise[p], weights = 1.0;
    for (std::size_t q = 0; q < size_; ++q) {
      const auto weight = static_cast<double>(weight_[p * size_ + q]);
      sum += weight * values[q];
      weights += weight;
    }
    result[p] = sum / weights;
  }
  return result;
}

void LikePixels::shrink(const Shrinkage& how, std::span<float> means, std::span<float> variances) const {
  const std::size_t columns = how.columns, stride = how.stride;
  std::vector<float> away(size_ * stride), of_others(size_ * stride, 0.0f),
      others_variance(size_ * stride, 0.0f), of_pixel(variances.begin(), variances.end());
  for (std::size_t at = 0; at < away.size(); ++at) away[at] = means[at] - how.predicted[at];
  for (std::size_t p = 0; p < size_; ++p) {
    float weights = kPredictionWeight;
    float* __restrict mean = &of_others[p * stride];
    float* __restrict variance = &others_variance[p * stride];
    for (std::size_t q = 0; q < size_; ++q) {
      const float weight = weight_[p * size_ + q];
      if (weight == 0.0f) continue;
      weights += weight;
      const float* __restrict a = &away[q * stride];
      const float* __restrict v = &variances[q * stride];
      for (std::size_t c = 0; c < columns; ++c) {
        mean[c] += weight * a[c];
        variance[c] += weight * weight * v[c];
      }
    }
    for (std::size_t c = 0; c < columns; ++c) {
      mean[c] /= weights;
      variance[c] /= weights * weights;
    }
  }
  // By how much a pixel differs from what the others say, beyond the noise of both: as it is told by itself and by those that show the
  // same. That it tells of itself spares pixels that are like no other.
  std::vector<float> differs(size_ * stride), between(columns), own_weight(columns);
  for (std::size_t p = 0; p < size_; ++p)
    for (std::size_t at = p * stride; at < p * stride + columns; ++at) {
      const float d = away[at] - of_others[at];
      differs[at] = d * d - variances[at] - others_variance[at];
    }
  const auto trust = static_cast<float>(how.trust);
  for (std::size_t p = 0; p < size_; ++p) {
    float weights = kPriorPixels;
    for (std::size_t c = 0; c < columns; ++c) between[c] = kPriorPixels * static_cast<float>(how.between[c]);
    for (std::size_t q = 0; q < size_; ++q) {
      const float weight = likeness_[p * size_ + q] + kAnyPixel;
      weights += weight;
      const float* __restrict of = &differs[q * stride];
      float* __restrict sum = between.data();
      for (std::size_t c = 0; c < columns; ++c) sum[c] += weight * of[c];
    }
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t at = p * stride + c, leader = how.leaders.empty() ? c : how.leaders[c];
      const float own = variances[at],
                  others = trust * (std::max(0.0f, between[c] / weights) + kLeastBetween * own) +
                           others_variance[at],
                  both = own + others;
      if (leader != c) {
        const float weight = own_weight[leader], rest = 1.0f - weight;
        means[at] = weight * means[at] + rest * (how.predicted[at] + of_others[at]);
        of_pixel[at] = weight * weight * own + rest * rest * others;
        continue;
      }
      own_weight[c] = both > 0.0f ? others / both : 1.0f;
      if (!(both > 0.0f)) continue;
      const float weight = own_weight[c];
      means[at] = weight * means[at] + (1.0f - weight) * (how.predicted[at] + of_others[at]);
      of_pixel[at] = own * weight;
    }
  }
  std::copy(of_pixel.begin(), of_pixel.end(), variances.begin());
}

}  // namespace ifov::sampling
