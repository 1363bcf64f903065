#pragma once

#include "io/document/shapes/primitive.h"

namespace ifov::io {

struct BoxPrimitive final : PrimitiveSettings {
  static const PrimitiveModel kModel;
  math::Point3 low_m, high_m;  ///< low < high in each coordinate
  Built build() const override { return {geometry::Box{low_m, high_m}}; }
};

}  // namespace ifov::io
