#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "math/vec3.h"
#include "render/moving/moving_parts.h"
#include "transport/shining_parts.h"

namespace ifov::render {

/// Something that shines, to which unseen light is bounded, where it is at one of several instants of an exposure.
struct ShiningTarget {
  transport::ShiningParts::Part part;
  math::Point3 centre_m;
  const MovingParts::Place* moving = nullptr;  ///< null: it stands still
  double way_m() const { return moving != nullptr ? moving->way_m : 0.0; }
  double reach_m() const { return part.ball.radius_m + way_m(); }
  double of_time() const { return moving != nullptr ? moving->of_time : 1.0; }
};

/// In a periodic scene where a place lies in its first copy; the place itself elsewhere.
math::Point3 at_home(const scene::Scene& scene, math::Point3 at);
/// From the first copy of a periodic scene to it and those about it; one of no length elsewhere.
std::vector<math::Vec3> copies_about(const scene::Scene& scene);
/// All parts, in a periodic scene in the copies about the first as well.
std::vector<ShiningTarget> still_targets(const scene::Scene& scene, const transport::ShiningParts& parts);
/// Put together by place where there are more than `most`: each group fills of the sphere about it what its parts do, as bright as the
/// brightest of them.
std::vector<ShiningTarget> put_together(std::vector<ShiningTarget> targets, std::size_t most);

/// What stands still, and behind it what moves, while a ray of some time is exposed.
class ShiningTargets {
 public:
  /// Keeps a reference to what moves.
  explicit ShiningTargets(const MovingParts& moving, std::vector<ShiningTarget> still = {})
      : places_(moving), all_(std::move(still)), still_(all_.size()) {}

  std::span<const ShiningTarget> at(double time_s) {
    const std::span<const MovingParts::Place> places = places_.at(time_s);
    all_.resize(still_);
    for (const MovingParts::Place& place : places) {
      transport::ShiningParts::Part part;
      part.ball = {place.centre_m, place.part->radius_m};
      part.fill = place.part->fill();
      part.assignment = place.part->assignment;
      part.contrast = HUGE_VAL;  // none of it counts for nothing
      all_.push_back({part, place.centre_m, &place});
    }
    return all_;
  }

 private:
  MovingParts::Places places_;
  std::vector<ShiningTarget> all_;
  std::size_t still_;
};

}  // namespace ifov::render
