#include "materials/bsdf/microfacet/facet_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>

#include "core/parallel.h"
#include "materials/bsdf/microfacet/row_weights.h"
#include "materials/bsdf/microfacet/visible_facets.h"

namespace ifov::materials {
namespace {

using std::numbers::pi;

constexpr std::size_t kSlants = 49;
constexpr std::size_t kAzimuthsOfQuadrant = 17;
constexpr std::size_t kKnots = 49;  // of the lobe
constexpr double kLeast = 1e-6;     // of a view that grazes

}  // namespace

FacetAlbedo::FacetAlbedo(const FacetDistribution& facets)
    : width_x_(facets.width_x()),
      width_y_(facets.width_y()),
      scale_(std::sqrt(width_x_ * width_y_)),
      azimuths_(width_x_ == width_y_ ? 1 : kAzimuthsOfQuadrant),
      lost_(azimuths_ * kSlants) {
  const VisibleFacets grid;
  parallel_for(static_cast<std::int64_t>(lost_.size()), 0, [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    const double turn =
        azimuths_ == 1 ? 0.0 : 0.5 * pi * static_cast<double>(k / kSlants) / (kAzimuthsOfQuadrant - 1);
    const double upright = std::max(kLeast, std::pow(static_cast<double>(k % kSlants) / (kSlants - 1), 2));
    const math::Vec3 out = math::normalized(
        {(1.0 - upright) * std::cos(turn) / width_x_, (1.0 - upright) * std::sin(turn) / width_y_, upright});
    double reflected = 0.0;
    grid.for_each_reflection(facets, out, [&](double weight, double, math::Vec3) { reflected += weight; });
    lost_[k] = std::max(0.0, 1.0 - reflected);
  });
  add_lobe();
}

std::shared_ptr<const FacetAlbedo> FacetAlbedo::shared(FacetShape shape, double width_x, double width_y) {
  using Key = std::tuple<FacetShape, double, double>;
  static std::mutex mutex;
  constexpr std::size_t kMost = 256;  // of 7 KB
  static std::map<Key, std::shared_ptr<const FacetAlbedo>> known;
  const std::lock_guard lock(mutex);
  if (known.size() >= kMost) known.clear();
  std::shared_ptr<const FacetAlbedo>& place = known[Key{shape, width_x, width_y}];
  if (!place) place = std::make_shared<FacetAlbedo>(FacetDistribution(shape, width_x, width_y));
  return place;
}

// By the slant of a view where widths have been stretched to 1, on which alone depends what is masked.
double FacetAlbedo::lost(math::Vec3 direction) const {
  const double x = std::abs(width_x_ * direction.x), y = std::abs(width_y_ * direction.y);
  const double cosine = std::max(0.0, direction.z);
  const RowWeights by_slant =
      cubic_weights(std::sqrt(cosine / (cosine + std::hypot(x, y))) * (kSlants - 1), kSlants);
  const auto along = [&](std::size_t azimuth) {
    const double* row = &lost_[azimuth * kSlants + by_slant.first];
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) sum += by_slant.weight[i] * row[i];
    return sum;
  };
  if (azimuths_ == 1) return std::max(0.0, along(0));
  const RowWeights by_azimuth =
      cubic_weights(std::atan2(y, x) / (0.5 * pi) * static_cast<double>(azimuths_ - 1), azimuths_);
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += by_azimuth.weight[i] * along(by_azimuth.first + i);
  return std::max(0.0, sum);
}

double FacetAlbedo::again(double lost_out, double lost_in) const {
  return mean_lost_ > 0.0 ? lost_out * lost_in / (pi * mean_lost_) : 0.0;
}

double FacetAlbedo::mean_over_azimuth(double cosine) const {
  constexpr int kOfQuadrant = 256;
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const int count = azimuths_ == 1 ? 1 : kOfQuadrant;
  double sum = 0.0;
  for (int k = 0; k < count; ++k) {
    const double azimuth = 0.5 * pi * (k + 0.5) / count;
    sum += lost({sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
  }
  return sum / count;
}

// Half of the knots lie where facets of this width shade each other.
double FacetAlbedo::position_of(double cosine) const {
  return (kKnots - 1) * cosine * (1.0 + scale_) / (cosine + scale_);
}
double FacetAlbedo::cosine_at(double position) const {
  const double t = position / (kKnots - 1);
  return std::min(1.0, scale_ * t / (1.0 + scale_ - t));
}

void FacetAlbedo::add_lobe() {
  for (std::size_t k = 0; k < kKnots; ++k) {
    cosine_.push_back(cosine_at(static_cast<double>(k)));
    // Above 0, so that the lobe reaches wherever light may go.
    lobe_.push_back(std::max(1e-12, mean_over_azimuth(cosine_[k])) * cosine_[k]);
  }
  below_.push_back(0.0);
  for (std::size_t k = 1; k < kKnots; ++k)
    below_.push_back(below_[k - 1] + 0.5 * (lobe_[k] + lobe_[k - 1]) * (cosine_[k] - cosine_[k - 1]));
  const double whole = below_.back();
  for (std::size_t k = 0; k < kKnots; ++k) {
    lobe_[k] /= whole;
    below_[k] /= whole;
  }
  // Simpson's rule, with several points between knots.
  constexpr std::size_t kPoints = 8 * (kKnots - 1);
  for (std::size_t j = 0; j <= kPoints; ++j) {
    const double position = static_cast<double>(j) / 8.0, t = position / (kKnots - 1);
    const double simpson = (j == 0 || j == kPoints ? 1.0 : j % 2 == 1 ? 4.0 : 2.0) / (3.0 * kPoints);
    const double cosine = cosine_at(position);
    const double rate = scale_ * (1.0 + scale_) / ((1.0 + scale_ - t) * (1.0 + scale_ - t));
    mean_lost_ += simpson * rate * 2.0 * cosine * mean_over_azimuth(cosine);
  }
}

std::size_t FacetAlbedo::interval_of(double cosine) const {
  const double position = position_of(std::clamp(cosine, 0.0, 1.0));
  std::size_t k = std::min(static_cast<std::size_t>(position), kKnots - 2);
  if (cosine < cosine_[k] && k > 0) --k;
  if (cosine > cosine_[k + 1] && k + 2 < kKnots) ++k;
  return k;
}

math::Vec3 FacetAlbedo::sample(sampling::Point2 u) const {
  const auto next = std::upper_bound(below_.begin() + 1, below_.end() - 1, u.x);
  const auto k = static_cast<std::size_t>(next - below_.begin()) - 1;
  const double step = cosine_[k + 1] - cosine_[k], slope = (lobe_[k + 1] - lobe_[k]) / step;
  // The root of lobe s + slope s^2 / 2 = rest that does not cancel.
  const double rest = std::max(0.0, u.x - below_[k]);
  const double root = lobe_[k] + std::sqrt(std::max(0.0, lobe_[k] * lobe_[k] + 2.0 * slope * rest));
  const double cosine = std::min(1.0, cosine_[k] + (root > 0.0 ? std::min(step, 2.0 * rest / root) : 0.0));
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), azimuth = 2.0 * pi * u.y;
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

double FacetAlbedo::pdf(math::Vec3 direction) const {
  const std::size_t k = interval_of(direction.z);
  const double slope = (lobe_[k + 1] - lobe_[k]) / (cosine_[k + 1] - cosine_[k]);
  return std::max(0.0, lobe_[k] + slope * (direction.z - cosine_[k])) / (2.0 * pi);
}

sampling::Point2 FacetAlbedo::invert(math::Vec3 direction) const {
  const std::size_t k = interval_of(direction.z);
  const double s = direction.z - cosine_[k],
               slope = (lobe_[k + 1] - lobe_[k]) / (cosine_[k + 1] - cosine_[k]);
  const double turn = std::atan2(direction.y, direction.x) / (2.0 * pi);
  return {std::clamp(below_[k] + s * (lobe_[k] + 0.5 * slope * s), 0.0, 1.0), turn < 0.0 ? turn + 1.0 : turn};
}

}  // namespace ifov::materials
