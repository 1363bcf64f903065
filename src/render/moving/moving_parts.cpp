#include "render/moving/moving_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "geometry/motion/motion.h"
#include "geometry/motion/moving_world.h"
#include "geometry/surface_piece.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/shapes/emitter_shape.h"
#include "transport/shining_parts.h"

namespace ifov::render {
namespace {

/// Of an exposure, at which it is asked where something is.
constexpr int kInstants = 8;

std::vector<bool> shining_assignments(const scene::Scene& scene, const transport::ShiningParts& parts) {
  std::vector<bool> shining;
  for (std::uint32_t a = 0; a < scene.assignments.size(); ++a) shining.push_back(parts.wants(a));
  return shining;
}

}  // namespace

MovingParts::MovingParts(const scene::Scene& scene, const sensor::Camera& camera,
                         const transport::ShiningParts& shining)
    : MovingParts(scene, camera, shining_assignments(scene, shining)) {
  if (camera.moves_while_exposed()) exposure_s_ = 0.0;
}

MovingParts::MovingParts(const scene::Scene& scene, const sensor::Camera& camera,
                         const std::vector<bool>& wanted)
    : world_(scene.world != nullptr && !wanted.empty() ? scene.world->moving() : nullptr),
      exposure_s_(camera.exposure_s()) {
  for (std::size_t m = 0; world_ != nullptr && m < world_->mover_count(); ++m) {
    std::map<std::uint32_t, Part> of_mover;
    std::map<std::uint32_t, std::vector<math::Point3>> ends;
    world_->body(m).visit_surfaces(wanted, [&](const geometry::SurfacePiece& piece) {
      const transport::EmitterShape shape(piece, false);
      const double r = shape.radius_m();
      of_mover[piece.material].area_m2 += geometry::area_m2(piece);
      for (const double sign : {-1.0, 1.0})
        ends[piece.material].push_back(shape.centre_m() + math::Vec3{sign * r, sign * r, sign * r});
    });
    for (auto& [assignment, part] : of_mover) {
      math::Point3 low = ends[assignment].front(), high = low;
      for (const math::Point3& end : ends[assignment]) {
        low = {std::min(low.x, end.x), std::min(low.y, end.y), std::min(low.z, end.z)};
        high = {std::max(high.x, end.x), std::max(high.y, end.y), std::max(high.z, end.z)};
      }
      part.mover = m, part.assignment = assignment;
      part.centre_m = low + 0.5 * (high - low), part.radius_m = 0.5 * math::length(high - low);
      parts_.push_back(part);
    }
  }
}

std::vector<MovingParts::Place> MovingParts::places(double time_s) const {
  const int instants = exposure_s_ > 0.0 ? kInstants : 1;
  std::vector<Place> places;
  for (const Part& part : parts_) {
    const auto at = [&](double share) {
      return world_->motion(part.mover)
          .scene_from_carrier(time_s + exposure_s_ * (share - 0.5))(part.centre_m);
    };
    for (int k = 0; k < instants; ++k) {
      const double middle = (k + 0.5) / instants;
      Place place{&part, at(middle), time_s + exposure_s_ * (middle - 0.5), 0.0, 1.0 / instants};
      if (instants > 1)
        place.way_m = std::max(math::length(at(middle - 0.5 / instants) - place.centre_m),
                               math::length(at(middle + 0.5 / instants) - place.centre_m));
      places.push_back(place);
    }
  }
  return places;
}

double MovingParts::Part::fill() const {
  return std::clamp(0.25 * area_m2 / (std::numbers::pi * radius_m * radius_m), 1e-4, 1.0);
}

std::span<const MovingParts::Place> MovingParts::Places::at(double time_s) {
  if (!of_.any()) return {};
  if (!known_ || time_s != time_s_) places_ = of_.places(time_s);
  known_ = true, time_s_ = time_s;
  return places_;
}

}  // namespace ifov::render
