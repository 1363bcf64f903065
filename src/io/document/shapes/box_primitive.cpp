#include "io/document/shapes/box_primitive.h"

#include "core/format.h"
#include "io/document/schema/record.h"

namespace ifov::io {
namespace {

SchemaType<std::shared_ptr<const PrimitiveSettings>> box_type() {
  Record<BoxPrimitive> record("box", "A box along the axes.");
  record.required("low", &BoxPrimitive::low_m, point(), "corner with the lowest coordinates")
      .required("high", &BoxPrimitive::high_m, point(), "the opposite corner")
      .check([](const BoxPrimitive& box, const DocumentNode& node) {
        const math::Vec3 size = box.high_m - box.low_m;
        if (!(size.x > 0.0 && size.y > 0.0 && size.z > 0.0)) {
          node.given("high").fail(
              format("{} is not above 'low' in every coordinate", node.given("high").title()));
        }
      });
  return primitive_type(record.type());
}

}  // namespace

constinit const PrimitiveModel BoxPrimitive::kModel{"box", box_type};

}  // namespace ifov::io
