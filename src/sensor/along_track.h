#pragma once

#include <vector>

#include "sampling/pixel_footprint.h"

namespace ifov::sensor {

/// What a line scanner's pixel is spread over along the image's y, in lines: the way of an element while it is exposed, its own length,
/// and the looks of the stages that add up to it (time delay and integration). Its response along y is the convolution of two boxes and
/// a comb, its modulation the product of theirs.
struct AlongTrack {
  double exposure_px = 1.0;  ///< above 0, at most 1: exposed in the middle of the line's period
  double element_px = 0.0;   ///< 0: none
  int stages = 1;
  double stage_px =
      0.0;  ///< how far each stage's look lies behind the last; 0 where the charge follows the ground
  /// How many lines (or samples of a sweep) a pitch of the focal plane is: by so much longer optics blur here than across.
  double pitch_px = 1.0;
  bool timed = false;  ///< of a scanner, whose lines or samples are times

  /// As before there were elements of a length: a pixel is a square of (across, time), of which a fill factor leaves the middle.
  bool plain() const { return exposure_px == 1.0 && element_px == 0.0 && stages == 1; }
  /// Likewise: elements that overlap do so across, and no line is exposed for longer than its period.
  bool square(double fill_factor) const { return plain() && !(timed && fill_factor > 1.0); }

  /// From the first look to the last, without the motion of an exposure.
  double reach_px() const { return element_px + (stages - 1) * stage_px; }

  /// The response, as pieces of a density.
  std::vector<sampling::PixelFootprint::Piece> pieces() const;

  /// |sinc(exposure v) sinc(element v) sin(pi n s v) / (n sin(pi s v))|, at v cycles a line.
  double mtf(double cycles_px) const;
};

}  // namespace ifov::sensor
