#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/moving/moving_parts.h"

namespace ifov::sampling {
struct TileResult;
}
namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class SpectralScene;
struct EmitterChoice;
}  // namespace ifov::transport

namespace ifov::render {

class AccuracyTolerance;

/// Light of emitters that are too many to be sought (transport::Emitters::left_out), or move, which scattered paths find by chance:
/// a pixel that met none of it may be sure of too little. What it may be at most follows from areas and distances, with
/// nothing in the way and all of it facing the surface; of what moves, on the mean over the pixel's exposure. That marks pixels; it
/// never enters a radiance.
class UnseenEmitters {
 public:
  /// Null where all are sought. Keeps references.
  static std::unique_ptr<const UnseenEmitters> find(const transport::SpectralScene& scene,
                                                    const sensor::Camera& camera);

  /// Widens the half-widths of a finished tile that has channels alone; pixels that become wider than was asked for get
  /// Reason::unseen_light. Adds the rays. Nothing without a tolerance.
  void settle(const AccuracyTolerance* tolerance, sampling::TileResult& tile) const;

  /// Less than this share of what was asked for is left alone.
  static constexpr double kNegligible = 0.1;

 private:
  UnseenEmitters(const transport::SpectralScene& scene, const sensor::Camera& camera);
  UnseenEmitters(const transport::SpectralScene& scene, const sensor::Camera& camera,
                 const transport::EmitterChoice& choice);
  /// Calls at(centre, radius, area, assignment, share of the exposure) for everything that is not sought.
  template <class At>
  void visit(std::span<const MovingParts::Place> places, const At& at) const;

  const transport::SpectralScene& scene_;
  const sensor::Camera& camera_;
  std::vector<std::vector<double>> highest_;  // by surface assignment: emission by channel
  MovingParts moving_;
  double mirrored_ = 0.0;  // so many times as much again may come by way of flat mirrors
};

}  // namespace ifov::render
