#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/surface_point.h"
#include "geometry/world/surface_survey.h"
#include "materials/bsdf/bsdf.h"

namespace ifov::scene {
struct Scene;
}

namespace ifov::transport {

class LobeTargets;

/// Surfaces with narrow lobes under the Sun: on what bends, a lobe's highlight is as small against the thing as its
/// micro-facets' slopes are against 1, and as bright as it is small. Rays would meet it seldom, so that it is looked for by
/// the surfaces' shapes, as glints on mirrors are.
class SunLobes {
 public:
  /// Half vectors lean by so many slopes where a highlight begins to be left to paths, and where all is: a lobe with the longest
  /// tail, GGX, keeps 1 % of its light beyond the first and a quarter of that beyond the second.
  static constexpr double kFirstSlopes = 10.0, kLastSlopes = 20.0;

  SunLobes(const scene::Scene& scene, const geometry::SurfaceSurvey& survey);
  ~SunLobes();

  /// Whether the highlight on a point that the sensor sees directly is found by its shape.
  bool by_shape(const geometry::SurfacePoint& hit) const;
  /// Whether a lobe's highlights on a surface are as small as it is narrow: it bends, or its normals do.
  bool bends(const geometry::SurfacePoint& hit) const {
    return hit.bend != geometry::Bend::none || tilted_[hit.material];
  }
  /// Slope that a lobe is widened to (Bsdf::widened_lobe) where paths have to find what it throws.
  static constexpr double kWidenedSlope = 0.3;
  /// Spheres about surfaces some of whose lobes throw_rarely(), and maybe about more; none where there is no such lobe.
  std::span<const geometry::SurfaceSurvey::Ball> throwers() const { return throwers_; }
  /// Whether there is such a lobe.
  bool any_throws_rarely() const { return any_throws_rarely_; }

  /// Share of the sunlight of such an event that is, 0 to 1: of what the lobe makes of it, all but the tail.
  static double share(const materials::Bsdf& bsdf, const materials::BsdfEvent& event);
  /// The same of what the sensor sees directly. Of a metal it is all: what its facets reflect again is as bright at a thing's rim,
  /// where it is as small as a highlight.
  static double seen_share(const materials::Bsdf& bsdf, const materials::BsdfEvent& event);
  /// How far from the Sun the directions may be, rad, that a sensor would see reflected where that is above 0.
  double seen_reach_rad() const { return seen_reach_rad_; }

  /// Whether rays are sent to a lobe for the sunlight that it throws on others: to targets().
  bool sought(const materials::Bsdf& bsdf) const;
  const LobeTargets& targets() const { return *targets_; }

  const geometry::SurfaceSurvey& survey() const { return survey_; }
  /// Of the materials with narrow lobes.
  materials::Bsdf::LobeSlopes slopes() const { return slopes_; }

 private:
  const geometry::SurfaceSurvey& survey_;
  materials::Bsdf::LobeSlopes slopes_;
  double seen_reach_rad_ = 0.0;
  std::vector<bool> flat_;    // by surface assignment: no relief tilts its normals, and no world repeats
  std::vector<bool> tilted_;  // by surface assignment: a relief does
  bool any_throws_rarely_ = false;
  std::vector<geometry::SurfaceSurvey::Ball> throwers_;
  std::vector<std::uint32_t> rounds_;  // objects, sorted
  std::unique_ptr<const LobeTargets> targets_;
};

}  // namespace ifov::transport
