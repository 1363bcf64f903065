#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "math/vec3.h"
#include "sampling/random.h"

namespace ifov::sampling {

/// A convex polygon as a plane surface sees it: the part above the surface's horizon, sampled uniformly in projected
/// solid angle, so that every direction carries the same share of the irradiance. The projection of the polygon onto the
/// plane is bounded by arcs of ellipses about the surface point, one for each edge (Nusselt's analogue); the area that one
/// sweeps is half of an arc tangent of its azimuth. Azimuths are found from those areas by safeguarded Newton steps, radii
/// in closed form (in the manner of Peters 2021, "BRDF importance sampling for polygonal lights").
class ProjectedPolygon {
 public:
  static constexpr std::size_t kMostCorners = 4;

  /// `corners`: 3 or 4, in order, as displacements from the surface point; `normal` unit.
  ProjectedPolygon(std::span<const math::Vec3> corners, math::Vec3 normal);

  /// Integral of the cosine over it, sr; 0 where nothing of it is above the horizon. By Lambert's formula.
  double projected_solid_angle_sr() const { return area_; }

  /// A direction (unit), of density cosine / projected_solid_angle_sr(). Not to be asked of an area of 0.
  math::Vec3 sample(Point2 u) const;

 private:
  /// An edge, as the arc of an ellipse that it projects to.
  struct Edge {
    double begin = 0.0, end = 0.0;  ///< azimuths, rising
    double turn = 0.0;              ///< of `begin`, from the ellipse's shorter half-axis
    double height = 0.0;            ///< that half-axis: |z| of the unit normal of the edge's plane
    double level = 0.0;             ///< 1 - height^2
    double sign = 0.0;              ///< 1: bounds the polygon from outside; -1: from inside
    double whole = 0.0;             ///< area swept
  };
  /// Of a direction: squares of sine and cosine of its angle with the normal.
  struct Height {
    double sine2 = 0.0, cosine2 = 1.0;
  };
  static double swept(const Edge& edge, double azimuth);
  static Height height(const Edge& edge, double azimuth);

  struct Arcs;
  using Part = std::array<math::Vec3, kMostCorners + 1>;

  math::Vec3 normal_;
  Part part_;  // above the horizon, anticlockwise, in the frame of TangentFrame(normal_)
  std::size_t corners_ = 0;
  double area_ = 0.0;
};

}  // namespace ifov::sampling
