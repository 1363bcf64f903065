#pragma once

#include <memory>

#include "math/vec3.h"
#include "radiometry/photometry.h"
#include "radiometry/spectrum.h"

namespace ifov::scene {

/// How radiance changes with the direction in which a surface gives off light.
class RadiationPattern {
 public:
  virtual ~RadiationPattern() = default;
  /// 0 to 1, of the brightest direction; `outgoing` unit, away from the surface (ENU). Called from many threads.
  virtual double at(math::Vec3 outgoing) const = 0;
};

/// Light that a surface gives off by itself, beside what its temperature makes it emit.
struct Lamp {
  radiometry::Spectrum radiance;                    ///< W m-2 sr-1 um-1, in the brightest direction
  std::shared_ptr<const RadiationPattern> pattern;  ///< null: the same in all directions
};

/// Full within `half_angle_rad` of an axis, and falling to nothing over `edge_rad` beyond it, smoothly (3 t^2 - 2 t^3).
class SpotPattern final : public RadiationPattern {
 public:
  SpotPattern(math::Vec3 axis, double half_angle_rad, double edge_rad);
  double at(math::Vec3 outgoing) const override;
  /// The integral over all directions, sr.
  double solid_angle_sr() const;

 private:
  double relative(double angle_rad) const;
  math::Vec3 axis_;
  double half_angle_rad_, edge_rad_;
};

/// Full on one side of a plane, nothing on the other: what a disk gives off that shines to one side.
class OneSidePattern final : public RadiationPattern {
 public:
  explicit OneSidePattern(math::Vec3 towards) : towards_(towards) {}
  double at(math::Vec3 outgoing) const override { return math::dot(towards_, outgoing) > 0.0 ? 1.0 : 0.0; }

 private:
  math::Vec3 towards_;
};

/// As a goniometer measured it: the vertical axis of the lamp that hangs points along `down`, and its plane of 0 deg
/// towards `about`, the part of it at right angles to `down`.
class GoniometerPattern final : public RadiationPattern {
 public:
  GoniometerPattern(radiometry::LuminousIntensity intensity, math::Vec3 down, math::Vec3 about);
  double at(math::Vec3 outgoing) const override;

 private:
  radiometry::LuminousIntensity intensity_;
  math::Vec3 down_, about_, across_;
};

}  // namespace ifov::scene
