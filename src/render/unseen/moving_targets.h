#pragma once

#include <span>
#include <vector>

#include "render/unseen/unseen_images.h"

/// For the sources of UnseenImages alone.
namespace ifov::render {

class UnseenImages::MovingTargets {
 public:
  explicit MovingTargets(const UnseenImages& of) : places_(of.moving_) {}
  std::span<const Target> at(double time_s);

 private:
  MovingParts::Places places_;
  std::vector<Target> targets_;
};

}  // namespace ifov::render
