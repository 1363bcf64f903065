#pragma once

#include <functional>

#include "thermal/solid.h"
#include "thermal/surface_exchange.h"

namespace ifov::thermal::test {

/// flux(t) + h (outer - T).
class LinearExchange : public SurfaceExchange {
 public:
  LinearExchange(std::function<double(double)> flux_w_m2, double h_w_m2_k = 0.0, double outer_k = 0.0)
      : flux_(std::move(flux_w_m2)), h_(h_w_m2_k), outer_k_(outer_k) {}
  SurfaceGain gain(double time_s, double surface_k) const override {
    return {flux_(time_s) + h_ * (outer_k_ - surface_k), -h_};
  }

 private:
  std::function<double(double)> flux_;
  double h_, outer_k_;
};

/// The solid of the reference data.
inline SolidLayer concrete(double thickness_m) { return {thickness_m, 1.4, 2300.0, 880.0}; }

}  // namespace ifov::thermal::test
