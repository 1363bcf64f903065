#include "materials/bsdf/microfacet/gaussian_slopes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/normal.h"

namespace ifov::materials::gaussian_slopes {
namespace {

constexpr double kSteepest = 8.0;  // beyond it erfc is below 1e-28
constexpr double kLeastShare = 1e-17;
constexpr double kSmallStep = 1e-9;

/// `density` is that of the slope, exp(-slope^2) / sqrt(pi).
double seen_below(double cosine, double sine, double slope, double density) {
  return 0.5 * (cosine * std::erfc(-slope) + sine * density);
}

double seen_below(double cosine, double sine, double slope) {
  return seen_below(cosine, sine, slope, std::numbers::inv_sqrtpi * std::exp(-slope * slope));
}

}  // namespace

double share(double slope) { return 0.5 * std::erfc(-slope); }

double quantile(double share) {
  return math::normal_quantile(std::clamp(share, kLeastShare, 1.0 - 0x1p-53)) / std::numbers::sqrt2;
}

double seen(double cosine, double sine) {
  return sine > 0.0 ? seen_below(cosine, sine, std::min(cosine / sine, kSteepest)) : cosine;
}

double seen_share(double cosine, double sine, double slope) {
  return std::min(1.0, seen_below(cosine, sine, slope) / seen(cosine, sine));
}

double seen_quantile(double cosine, double sine, double share) {
  const double wanted = std::max(kLeastShare, share) * seen(cosine, sine);
  double low = -kSteepest, high = sine * kSteepest > cosine ? cosine / sine : kSteepest;
  double slope = std::clamp(quantile(share), low, high);
  // Newton's steps, kept within what is known to hold the root. After one below kSmallStep the error is its square.
  for (int k = 0; k < 60; ++k) {
    const double density = std::numbers::inv_sqrtpi * std::exp(-slope * slope);
    const double excess = seen_below(cosine, sine, slope, density) - wanted;
    (excess > 0.0 ? high : low) = slope;
    const double next = slope - excess / ((cosine - slope * sine) * density);
    if (std::abs(next - slope) <= kSmallStep) return std::clamp(next, low, high);
    slope = next > low && next < high ? next : 0.5 * (low + high);
  }
  return slope;
}

}  // namespace ifov::materials::gaussian_slopes
