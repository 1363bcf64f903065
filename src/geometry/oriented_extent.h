#pragma once

#include <array>
#include <span>

#include "geometry/world.h"
#include "math/vec3.h"

namespace ifov::geometry {

/// Half the sides of a box about some points, as vectors in their frame, longest first.
using HalfSides = std::array<math::Vec3, 3>;

/// The box along the axes, or the one along the points' own longest direction where that is narrower: it shows how
/// thin a rod is whichever way it lies.
HalfSides oriented_extent(std::span<const math::Point3> points, const World::Bounds& bounds);

}  // namespace ifov::geometry
