#pragma once

namespace ifov::thermal {

/// What a surface gains on its outer side, W m-2, at a temperature of its own, and how that changes with it, W m-2 K-1:
/// 0 or below, because what is warmer loses more.
struct SurfaceGain {
  double w_m2 = 0.0;
  double slope_w_m2_k = 0.0;
};

/// All that a surface exchanges with what is outside: a function of time and its temperature. Nothing of it depends on
/// what was, which is the solid's part.
class SurfaceExchange {
 public:
  virtual ~SurfaceExchange() = default;
  virtual SurfaceGain gain(double time_s, double surface_k) const = 0;
};

/// The temperature at which a surface passes on what it gains: gain(T) = conductance (T - inner_k), by Newton's method
/// within bounds that close in, to 1e-9 K or rounding. A conductance of 0: nothing passes, a surface in equilibrium.
/// Throws InputError where there is none between 0 and 10,000 K.
double balanced_temperature_k(const SurfaceExchange& exchange, double time_s, double conductance_w_m2_k,
                              double inner_k, double guess_k);

}  // namespace ifov::thermal
