#pragma once

#include <cstddef>

#include "studies/common/study_options.h"

/// What moves under a frame camera, and how well its image is known.
namespace ifov::studies {

/// A frame 300 m above a hot plate on cold black ground that moves north-east: pixels of 0.3 m.
struct MovingCar {
  double exposure_s = 0.01, row_period_s = 0.0;
  double east_m_s = 30.0, north_m_s = 7.0;
};
/// How far its edges are from where kinematics puts them: the largest difference of what it covers of a pixel, a row or a column,
/// in pixels. `stands`: a planted fault, the plate stands still.
double moving_car_off_px(const MovingCar& car, const StudyOptions& options, bool stands = false);

/// Of images of a yard under Sun and sky across which a box moves, with a mirror on a wall or without it: pixels whose intervals hold the
/// mean over images in which it stands where it is at many instants, and all; then those that show that it moves.
struct MovingHeld {
  std::size_t held = 0, pixels = 0, held_moving = 0, moving = 0;
  double share() const { return static_cast<double>(held) / static_cast<double>(pixels); }
  double moving_share() const { return static_cast<double>(held_moving) / static_cast<double>(moving); }
};
struct MovingYard {
  bool rolling = false, mirror = false;
  int seeds = 2, instants = 24;
};
/// Images of the yard with all at rest: the mean over the exposure, or each row at its instant; and all at the middle of it.
struct MovingTruth {
  std::vector<double> moving, at_rest;
};
MovingTruth moving_truth(const MovingYard& yard, const StudyOptions& options);
MovingHeld moving_held(const MovingYard& yard, const MovingTruth& truth, const StudyOptions& options,
                       bool stands = false);

}  // namespace ifov::studies
