#include "sensor/optics/carrier_diffusion.h"

#include <cmath>
#include <numbers>

namespace ifov::sensor {
namespace {

/// Of light from the front, not yet over that at 0.
double collected(const CarrierDiffusion& d, double length_px) {
  return 1.0 - std::exp(-d.absorption_per_px * d.depletion_px) / (1.0 + d.absorption_per_px * length_px);
}

/// cosh(a) / cosh(b), b >= a >= 0, neither of which need be small.
double cosh_ratio(double a, double b) {
  return std::exp(a - b) * (1.0 + std::exp(-2.0 * a)) / (1.0 + std::exp(-2.0 * b));
}

}  // namespace

double CarrierDiffusion::mtf(double cycles_px) const {
  const double wave = 2.0 * std::numbers::pi * std::abs(cycles_px);
  const double inverse = length_px ? 1.0 / *length_px : 0.0, inverse_here = std::hypot(inverse, wave);
  if (field_free_px > 0.0) return cosh_ratio(field_free_px * inverse, field_free_px * inverse_here);
  return collected(*this, 1.0 / inverse_here) / collected(*this, *length_px);
}

double CarrierDiffusion::staying() const {
  return field_free_px > 0.0 ? 0.0 : collected(*this, 0.0) / collected(*this, *length_px);
}

double CarrierDiffusion::reach_px() const {
  // Of light from behind they are fewer by exp(-pi r / 2 t), from the front by exp(-r / L).
  constexpr double kFew = 16.0;
  return kFew * (field_free_px > 0.0 ? 2.0 / std::numbers::pi * field_free_px : *length_px);
}

double CarrierDiffusion::variance_px2() const {
  // Of the second derivative at 0: with s = (2 pi f)^2 the modulation is 1 - variance s / 2 + ...
  if (field_free_px > 0.0) {
    if (!length_px) return field_free_px * field_free_px;
    const double x = field_free_px / *length_px;
    return *length_px * *length_px * x * std::tanh(x);
  }
  const double l = *length_px, a = absorption_per_px, one = 1.0 + a * l;
  return std::exp(-a * depletion_px) * a * l * l * l / (one * one) / collected(*this, l);
}

}  // namespace ifov::sensor
