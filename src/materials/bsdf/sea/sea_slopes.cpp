#include "materials/bsdf/sea/sea_slopes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::materials {
namespace {

// Cox and Munk 1954: what does not depend on the wind.
constexpr double kC40 = 0.40, kC22 = 0.12, kC04 = 0.23;
constexpr double kMostSeries = 5.0;

double along_of(double wind, SlopeStatistics statistics) {
  return statistics == SlopeStatistics::isotropic ? 0.5 * (0.003 + 0.00512 * wind) : 0.00316 * wind;
}
double across_of(double wind, SlopeStatistics statistics) {
  return statistics == SlopeStatistics::isotropic ? 0.5 * (0.003 + 0.00512 * wind) : 0.003 + 0.00192 * wind;
}

double fourth_hermite(double x) { return (x * x - 6.0) * x * x + 3.0; }

}  // namespace

SeaSlopes::SeaSlopes(double wind, SlopeStatistics statistics)
    : variance_along_(along_of(wind, statistics)),
      variance_across_(across_of(wind, statistics)),
      gaussian_(FacetShape::beckmann, std::sqrt(2.0 * variance_along_), std::sqrt(2.0 * variance_across_)),
      is_skewed_(statistics == SlopeStatistics::skewed),
      c21_(0.01 - 0.0086 * wind),
      c03_(0.04 - 0.033 * wind) {
  if (!is_skewed_) return;
  constexpr int kSteps = 240;
  constexpr double kLast = 6.0;
  double sum = 0.0, whole = 0.0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double across = kLast * (2.0 * (i + 0.5) / kSteps - 1.0),
                   along = kLast * (2.0 * (j + 0.5) / kSteps - 1.0);
      const double gaussian = std::exp(-0.5 * (across * across + along * along));
      whole += gaussian;
      sum += gaussian * raw_series(across, along);
    }
  scale_ = whole / sum;
}

double SeaSlopes::raw_series(double across, double along) const {
  const double x2 = across * across - 1.0, y2 = along * along - 1.0;
  const double series = 1.0 - 0.5 * c21_ * x2 * along - c03_ / 6.0 * (y2 - 2.0) * along +
                        kC40 / 24.0 * fourth_hermite(across) + kC22 / 4.0 * x2 * y2 +
                        kC04 / 24.0 * fourth_hermite(along);
  return std::clamp(series, 0.0, kMostSeries);
}

double SeaSlopes::series(math::Vec3 facet) const {
  if (!is_skewed_) return 1.0;
  if (!(facet.z > 0.0)) return 0.0;
  // The surface rises against the wind where its normal leans with the wind.
  return scale_ * raw_series(facet.y / (facet.z * std::sqrt(variance_across_)),
                             -facet.x / (facet.z * std::sqrt(variance_along_)));
}

double SeaSlopes::projected_area(math::Vec3 direction) const {
  const double gaussian = gaussian_.projected_area(direction);
  if (!is_skewed_) return gaussian;
  // Slopes along the direction, in units of their standard deviation `spread`, up to `last`, beyond which
  // they are turned away. The integral of (last - t) He_n(t) over the Gaussian, below last, is He_(n-2)(last)
  // times the Gaussian there.
  const double x = std::sqrt(variance_along_) * direction.x, y = std::sqrt(variance_across_) * direction.y;
  const double spread = std::hypot(x, y), cosine = std::max(0.0, direction.z);
  if (!(cosine < 8.0 * spread)) return gaussian;
  const double last = cosine / spread, along = x / spread, across = y / spread;
  const double a2 = along * along, b2 = across * across;
  const double third = -(c03_ * a2 + 3.0 * c21_ * b2) * along;
  const double fourth = kC04 * a2 * a2 + 6.0 * kC22 * a2 * b2 + kC40 * b2 * b2;
  const double peak = std::exp(-0.5 * last * last) / std::sqrt(2.0 * std::numbers::pi);
  const double more = spread * peak * (third / 6.0 * last + fourth / 24.0 * (last * last - 1.0));
  return std::max(gaussian + more, std::max(cosine, 0.5 * gaussian));
}

SeaReflection::SeaReflection(const SeaSlopes& slopes, math::Vec3 out, math::Vec3 in)
    : FacetReflection(slopes.gaussian(), out, in) {
  if (!slopes.is_skewed()) return;
  const math::Vec3 facet = math::normalized(out + in);
  const double area_out = slopes.projected_area(out), area_in = slopes.projected_area(in);
  bsdf = 0.25 * slopes.density(facet) / (area_out * in.z + area_in * out.z - out.z * in.z);
}

}  // namespace ifov::materials
