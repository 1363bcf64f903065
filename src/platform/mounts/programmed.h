#pragma once

#include <vector>

#include "platform/bearing.h"
#include "platform/cubic_spline.h"

namespace ifov::platform {

/// Looks at one place for a time, then at the next one, whatever its carrier does: angles from stare to stare, and from the last back to
/// the first. In between it turns as a raised cosine.
class StepStare final : public Bearing {
 public:
  struct Settings {
    geodesy::Attitude first, step;
    int steps = 1;                        ///< places
    double start_s = 0.0;                 ///< of a stare at the first place
    double period_s = 1.0, slew_s = 0.0;  ///< from stare to stare, of which so long it turns
  };

  explicit StepStare(const Settings& settings) : settings_(settings) {}

  geodesy::Attitude angles(double time_s, const Pose& carrier) const override;
  double step_s() const override;
  std::string told(std::span<const double>, std::span<const geodesy::Attitude> angles) const override {
    return "turns in steps, " + angles_told(angles);
  }
  void check(std::span<const double> times_s, std::span<const geodesy::Attitude> angles) const override;

 private:
  Settings settings_;
};

/// Angles by time, smooth between the times that are given.
class TurnTable final : public Bearing {
 public:
  /// At least one row; times increase.
  TurnTable(std::vector<double> times_s, std::span<const geodesy::Attitude> angles);

  geodesy::Attitude angles(double time_s, const Pose& carrier) const override;
  double step_s() const override { return step_s_; }
  std::string told(std::span<const double>, std::span<const geodesy::Attitude> angles) const override {
    return "turns by its table, " + angles_told(angles);
  }
  /// InputError where it does not cover the times.
  void check(std::span<const double> times_s, std::span<const geodesy::Attitude> angles) const override;

 private:
  double step_s_;
  CubicSpline spline_;
};

}  // namespace ifov::platform
