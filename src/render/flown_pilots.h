#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "render/pilot_rays.h"

namespace ifov::render {

class FlownExposure;

/// Pilot rays under a camera that moves while it is exposed.
class FlownPilots {
 public:
  /// Those of the camera at each instant of FlownExposure.
  explicit FlownPilots(std::vector<PilotRays> by_instant) : by_instant_(std::move(by_instant)) {}

  bool any() const { return !by_instant_.empty(); }
  /// Those near a tile, of all instants; `exposure` is told where what is small is when.
  PilotRays::Near near(sampling::PixelRect tile, double margin_px, FlownExposure& exposure) const;

 private:
  std::vector<PilotRays> by_instant_;
};

/// A camera that moves while it is exposed, as it stands so long after the middle of the exposure.
std::unique_ptr<const sensor::Camera> camera_at(const sensor::Camera& camera, double time_s);

}  // namespace ifov::render
