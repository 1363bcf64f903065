#pragma once

#include <cstddef>
#include <vector>

#include "radiometry/mueller.h"

namespace ifov::render {

/// What a sensor tells of the polarization of light, and what of it stands before its channels.
struct Polarimetry {
  bool stokes = false;  ///< Q, U and V are told beside I
  /// By channel: what polarizers and retarders make of light, about the axes of the focal plane
  /// (sensor::focal_frame()); empty: there are none.
  std::vector<radiometry::MuellerMatrix> optics{};

  bool any() const { return stokes || !optics.empty(); }
  /// Numbers of a sample that are told of so many channels: I of each, then Q, U and V of each where they are.
  std::size_t told(std::size_t channels) const { return channels * (stokes ? 4 : 1); }
  /// Numbers that it has: behind them, where there are optics, I of each channel before them, which nobody judges.
  std::size_t columns(std::size_t channels) const { return told(channels) + (optics.empty() ? 0 : channels); }
  /// What is left of unpolarized light.
  double passed(std::size_t channel) const { return optics.empty() ? 1.0 : optics[channel](0, 0); }
};

}  // namespace ifov::render
