#include "thermal/surface_exchange.h"

#include <cmath>

#include "core/error.h"

namespace ifov::thermal {

double balanced_temperature_k(const SurfaceExchange& exchange, double time_s, double conductance_w_m2_k,
                              double inner_k, double guess_k) {
  constexpr double kHottest_k = 1e4, kEnough_k = 1e-9;
  double low_k = 0.0, high_k = kHottest_k, surface_k = guess_k;
  double last_change_k = kHottest_k, change_before_k = kHottest_k;
  for (int i = 0; i < 200; ++i) {
    const SurfaceGain gain = exchange.gain(time_s, surface_k);
    const double left = gain.w_m2 - conductance_w_m2_k * (surface_k - inner_k);
    (left > 0.0 ? low_k : high_k) = surface_k;
    double next_k = surface_k + left / (conductance_w_m2_k - gain.slope_w_m2_k);
    // About a cusp, where the surface is as warm as the air, Newton's steps go to and fro: they are to halve within two.
    if (!(next_k >= low_k && next_k <= high_k) || std::abs(next_k - surface_k) > 0.5 * change_before_k)
      next_k = 0.5 * (low_k + high_k);
    const double change_k = std::abs(next_k - surface_k);
    change_before_k = last_change_k;
    last_change_k = change_k;
    surface_k = next_k;
    if (change_k < kEnough_k) {
      if (surface_k >= kHottest_k - 1.0 || surface_k <= kEnough_k) break;
      return surface_k;
    }
  }
  throw InputError("found no temperature from 0 to 10000 K at which the surface loses what it gains");
}

}  // namespace ifov::thermal
