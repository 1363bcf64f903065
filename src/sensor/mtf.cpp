#include "sensor/mtf.h"

#include <cmath>
#include <numbers>

namespace ifov::sensor {
namespace {

constexpr double kPi = std::numbers::pi;

/// Share that two discs of diameter 1 have in common, s apart.
double common_disc(double s) {
  return s < 1.0 ? 2.0 / kPi * (std::acos(s) - s * std::sqrt(1.0 - s * s)) : 0.0;
}

/// Twice the area that a disc of diameter 1 and one of diameter e have in common, s apart, over that of the former.
double common_with_obscuration(double s, double e) {
  if (s <= 0.5 * (1.0 - e)) return 2.0 * e * e;
  if (s >= 0.5 * (1.0 + e)) return 0.0;
  const double phi = std::acos((1.0 + e * e - 4.0 * s * s) / (2.0 * e));
  return 2.0 * e * e - 2.0 * e / kPi * std::sin(phi) - (1.0 + e * e) / kPi * phi +
         2.0 * (1.0 - e * e) / kPi * std::atan((1.0 + e) / (1.0 - e) * std::tan(0.5 * phi));
}

}  // namespace

double square_mtf(double side_px, double cycles_px) {
  const double x = kPi * side_px * cycles_px;
  return std::abs(x) < 1e-8 ? 1.0 : std::sin(x) / x;
}

double gaussian_mtf(double sigma_px, double cycles_px) {
  return std::exp(-2.0 * kPi * kPi * sigma_px * sigma_px * cycles_px * cycles_px);
}

double diffraction_mtf(double q_px, double obscuration, double cycles_px) {
  const double s = q_px * std::abs(cycles_px), e = obscuration;
  if (!(e > 0.0)) return common_disc(s);
  return (common_disc(s) + e * e * common_disc(s / e) - common_with_obscuration(s, e)) / (1.0 - e * e);
}

}  // namespace ifov::sensor
