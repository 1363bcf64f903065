#pragma once

#include <vector>

#include "geometry/motion/time_interval.h"
#include "geometry/world.h"
#include "math/ray.h"
#include "math/transform.h"

namespace ifov::geometry {

class Motion;

/// Where a box that moves is over a time: a chain of boxes, each of which holds it for one of many equal steps of that time.
class SweptBoxes {
 public:
  /// Of a box in the frame of what carries it, from `from_s` to `to_s`.
  SweptBoxes(const Motion& motion, World::Bounds box, double from_s, double to_s);

  /// Whether the box may lie on the ray, between its ends, at some time of these; never no where it does. `spread_rad`: of a cone about
  /// the ray. Times beyond those of the sweep are no part of it.
  bool may_meet(const math::Ray& ray, double from_s, double to_s, double spread_rad = 0.0) const;
  /// The steps of that time in which it may, as times from and until, behind those that are there; neighbours are joined.
  void when(const math::Ray& ray, double from_s, double to_s, double spread_rad,
            std::vector<TimeInterval>& times) const;
  bool covers(double time_s) const { return time_s >= from_s_ && time_s <= to_s_; }

  World::Bounds reach() const { return reach_; }  ///< of where it is, scene frame
  /// Of all that may_meet() takes to be its place.
  World::Bounds hull() const { return hull_; }

  /// The box at one instant.
  static bool meets(const math::Ray& in_carrier, const World::Bounds& box);

 private:
  struct Step {
    math::Transform box_from_scene;
    World::Bounds box;
  };
  static constexpr std::size_t kBlock = 16;
  std::size_t step_at(double time_s) const;
  /// found(step): whether to go on.
  template <class Found>
  void find(const math::Ray& ray, double from_s, double to_s, double spread_rad, const Found& found) const;

  double from_s_, to_s_;
  std::vector<Step> steps_;
  std::vector<World::Bounds> blocks_;  // scene frame, of kBlock steps each
  World::Bounds hull_, reach_;         // of the steps; of the box at many instants
};

}  // namespace ifov::geometry
