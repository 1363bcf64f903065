#pragma once

#include "geometry/triangle_mesh.h"

namespace ifov::landscape {

enum class CarKind { sedan, estate, van };
inline constexpr int kCarKinds = 3;

/// A car that heads along +x, its wheels on z = 0, the middle of its wheelbase at the origin; 4.3 to 5 m long.
/// Slots: body, glass, tyre, trim, lamp.
geometry::TriangleMesh car_mesh(CarKind kind);

}  // namespace ifov::landscape
