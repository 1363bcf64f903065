#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "render/mirrors/mirror_images.h"
#include "render/unseen/unseen_images.h"

/// For the sources of UnseenImages alone.
namespace ifov::render {

class UnseenImages::MovingTargets {
 public:
  explicit MovingTargets(const UnseenImages& of) : of_(of), places_(of.moving_) {}
  std::span<const Target> at(double time_s) {
    const std::span<const MovingParts::Place> places = places_.at(time_s);
    targets_.clear();
    for (const MovingParts::Place& place : places) {
      transport::ShiningParts::Part part;
      part.ball = {place.centre_m, place.part->radius_m};
      part.fill = place.part->fill();
      part.assignment = place.part->assignment;
      part.contrast = HUGE_VAL;  // none of it counts for nothing
      targets_.push_back({part, place.centre_m, &place});
    }
    return targets_;
  }

 private:
  const UnseenImages& of_;
  MovingParts::Places places_;
  std::vector<Target> targets_;
};

}  // namespace ifov::render
