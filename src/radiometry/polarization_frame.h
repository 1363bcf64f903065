#pragma once

#include "math/vec3.h"
#include "radiometry/mueller.h"

namespace ifov::radiometry {

/// What a StokesVector is about: the direction in which light propagates and the axis x across it, both unit
/// vectors of any one right-handed frame of space. The axis y = k cross x completes them.
struct PolarizationFrame {
  math::Vec3 direction{0.0, 0.0, 1.0};
  math::Vec3 x{1.0, 0.0, 0.0};
  math::Vec3 y() const { return cross(direction, x); }
};

/// Light with the frame that it is about.
struct PolarizedLight {
  StokesVector stokes;
  PolarizationFrame frame;
};

/// Frame whose x lies in the vertical plane and points down where light goes up or level (e_theta of spherical
/// coordinates; z is up), so that y = e_phi is level. Light that propagates with cosine `mu` from the zenith
/// towards this azimuth, counted from x of space towards its y: right at the vertical, too, where the azimuth
/// chooses the plane.
PolarizationFrame meridional_frame(double mu, double azimuth_rad);
/// The same for a unit vector; azimuth 0 at the vertical itself.
PolarizationFrame meridional_frame(math::Vec3 direction);

/// The frame carried along the great circle to another direction, not the opposite one: parallel transport,
/// which turns nothing about the direction. Frames of directions side by side, carried to one of them, tell
/// how light differs between them and not how frames do.
PolarizationFrame carried(const PolarizationFrame& frame, math::Vec3 direction);

/// Frame whose x lies in the plane of a direction and a surface's normal (p), so that y = direction cross normal, made
/// a unit vector, lies in the surface (s); either side's normal serves. Along the normal, where every plane
/// contains both, the meridional one: it is the same plane for light that arrives and light that leaves.
PolarizationFrame surface_frame(math::Vec3 direction, math::Vec3 normal);

/// Takes what is about one frame to another of the same direction. Its components of x alone count.
MuellerMatrix turned(const PolarizationFrame& from, const PolarizationFrame& to);

/// Frames of light before and after it is scattered, with x in the plane of both directions and one common y
/// across it, along before.direction cross after.direction. Forward and backward, where any plane serves, it
/// is the vertical one.
struct ScatteringFrames {
  PolarizationFrame before, after;
};
ScatteringFrames scattering_frames(math::Vec3 before, math::Vec3 after);

/// A matrix about `own` frames, about others of the same directions.
MuellerMatrix about(const MuellerMatrix& matrix, const ScatteringFrames& own, const PolarizationFrame& before,
                    const PolarizationFrame& after);

}  // namespace ifov::radiometry
