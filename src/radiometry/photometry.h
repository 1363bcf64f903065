#pragma once

#include <vector>

#include "radiometry/spectrum.h"

namespace ifov::radiometry {

/// Luminous flux of a watt at 540 THz, lm/W: exact (SI, 2019).
inline constexpr double kLuminousEfficacy_lm_w = 683.0;

/// V(lambda), CIE 1924, photopic vision; 0 outside 0.36 to 0.8 um. Compiled in from data/luminous_efficiency.csv.
const Spectrum& luminous_efficiency();

/// Luminous flux (lm) of a spectral flux (W um-1); likewise of intensity or radiance what eyes see of it.
double luminous(const Spectrum& per_um);

/// Luminous intensity by direction, as goniometers tell it: type C of IES LM-63, planes through the vertical axis of a lamp
/// that hangs.
class LuminousIntensity {
 public:
  /// Angles from straight down, 0 to 180 deg or less, and about the vertical axis; both rise. `candela` by plane, then by
  /// angle from straight down. One plane: the same all around; planes from 0 to 90 deg: mirrored in both that bound them;
  /// 0 to 180 deg or 90 to 270 deg: mirrored in that plane; 0 to 360 deg: as they are. Outside the given angles from straight down
  /// there is no light. InputError where they are none of these, or where numbers are missing, negative or all 0.
  LuminousIntensity(std::vector<double> from_down_deg, std::vector<double> about_deg,
                    std::vector<double> candela);

  /// Candela; both angles in radians. Linear between angles.
  double at(double from_down_rad, double about_rad) const;
  double highest() const { return highest_; }
  /// The integral over all directions, lm.
  double flux_lm() const;

 private:
  double in_plane(std::size_t plane, double from_down_deg) const;
  std::vector<double> from_down_deg_, about_deg_, candela_;
  double highest_ = 0.0;
};

}  // namespace ifov::radiometry
