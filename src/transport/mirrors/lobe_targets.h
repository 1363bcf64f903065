#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/world/surface_survey.h"
#include "math/vec3.h"
#include "sampling/warp.h"
#include "transport/mirrors/facet_clusters.h"
#include "transport/shapes/round_mirror.h"

namespace ifov::transport {

/// Where the highlights are that surfaces with narrow lobes show to other surfaces: as small against what shows them as the
/// lobes are narrow, so that scattered rays meet them seldom. A surface sends rays there besides, and both are
/// weighed by their densities (Veach and Guibas 1995, balance heuristic): what a target lacks is found as before.
class LobeTargets {
 public:
  LobeTargets(const geometry::SurfaceSurvey& survey, math::Vec3 towards_sun, double slope);

  bool empty() const { return targets_.empty(); }

 private:
  friend class LobeView;
  static constexpr std::size_t kMostRounds = 32, kMostClusters = 32, kMostGroups = 16,
                               kMost = kMostRounds + kMostClusters + kMostGroups;
  struct Target {
    geometry::SurfaceSurvey::Ball ball;
    std::optional<RoundMirror> round;
    bool facets = false;  // of the cluster:
    math::Vec3 normal;    // towards the Sun's side
    double spread = 0.0;
  };
  struct Cone {
    math::Vec3 axis;
    double versine = 0.0;  // 1 - cosine of its half angle
  };
  /// Directions about the Sun's image, as widely as a lobe throws them.
  struct Highlight {
    math::Vec3 axis;
    double width = 0.0;  // a slope
    math::Vec3 sample(sampling::Point2 u) const;
    double density(math::Vec3 direction) const;
  };

  std::vector<Target> targets_;
  math::Vec3 towards_sun_;
  double slope_;
};

/// The targets as a point on a surface of a unit normal sees them.
class LobeView {
 public:
  void fill(const LobeTargets& targets, math::Point3 from, math::Vec3 normal);
  /// A direction; `choice` and `u` uniform in [0, 1).
  math::Vec3 sample(double choice, sampling::Point2 u) const;
  /// The density of sample(), 1/sr.
  double density(math::Vec3 direction) const;

 private:
  struct Aim {
    double share = 0.0;  // of rays, up to a factor
    LobeTargets::Cone whole;
    LobeTargets::Highlight highlight;
    bool shows = false;  // a highlight smaller than the whole
  };
  std::array<Aim, LobeTargets::kMost> aims_;
  std::size_t count_ = 0;
  double all_ = 0.0;
};

}  // namespace ifov::transport
