#pragma once

#include "io/document/schema/schema_type.h"
#include "math/transform.h"

namespace ifov::io {

/// A length above zero.
SchemaType<double> positive_length();

/// Turns +z to a direction of any length above zero, and moves the origin to `position_m`.
math::Transform upright_to(math::Point3 position_m, math::Vec3 direction);

}  // namespace ifov::io
