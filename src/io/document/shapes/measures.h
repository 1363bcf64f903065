#pragma once

#include "io/document/schema/kind.h"
#include "math/transform.h"

namespace ifov::io {

/// A length above zero.
Kind<double> positive_length();

/// Turns +z to a direction of any length above zero, and moves the origin to `place_m`.
math::Transform upright_to(math::Point3 place_m, math::Vec3 direction);

}  // namespace ifov::io
