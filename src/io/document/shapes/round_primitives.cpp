#include "io/document/shapes/round_primitives.h"

#include "core/format.h"
#include "io/document/schema/record.h"
#include "io/document/shapes/measures.h"

namespace ifov::io {
namespace {

template <class T>
SchemaType<std::shared_ptr<const PrimitiveSettings>> ball_type(const std::string& name,
                                                               const std::string& doc) {
  Record<T> record(name, doc);
  record.required("center", &T::centre_m, point(), "its centre")
      .required("radius", &T::radius_m, positive_length(), "its radius");
  return primitive_type(record.type());
}

SchemaType<std::shared_ptr<const PrimitiveSettings>> sphere_type() {
  return ball_type<SpherePrimitive>("sphere", "A sphere.");
}

SchemaType<std::shared_ptr<const PrimitiveSettings>> hemisphere_type() {
  return ball_type<HemispherePrimitive>("hemisphere", "The upper half of a sphere, without a floor.");
}

bool is_upright(const CylinderPrimitive& cylinder) {
  return cylinder.axis_m.x == 0.0 && cylinder.axis_m.y == 0.0 && cylinder.axis_m.z > 0.0;
}

SchemaType<std::shared_ptr<const PrimitiveSettings>> cylinder_type() {
  Record<CylinderPrimitive> record("cylinder", "A circular cylinder.");
  record.required("base", &CylinderPrimitive::base_m, point(), "centre of its base")
      .required("radius", &CylinderPrimitive::radius_m, positive_length(), "its radius")
      .exactly_one()
      .one("axis",
           via([](CylinderPrimitive& c, math::Vec3 axis) { c.axis_m = axis; },
               [](const CylinderPrimitive& c) { return is_upright(c) ? nullptr : &c.axis_m; }),
           displacement(), "from the centre of the base to that of the top")
      .one("height",
           via(
               [](CylinderPrimitive& c, double h) {
                 c.axis_m = {0.0, 0.0, h};
               },
               [](const CylinderPrimitive& c) { return is_upright(c) ? &c.axis_m.z : nullptr; }),
           positive_length(), "of an upright cylinder")
      .with_default("capped", &CylinderPrimitive::capped, boolean(), "true", "with a disk at each end")
      .check([](const CylinderPrimitive& cylinder, const DocumentNode& node) {
        if (!(math::length(cylinder.axis_m) > 0.0)) {
          node.given("axis").fail(format("{} has no length", node.given("axis").title()));
        }
      });
  return primitive_type(record.type());
}

}  // namespace

constinit const PrimitiveModel SpherePrimitive::kModel{"sphere", sphere_type};
constinit const PrimitiveModel HemispherePrimitive::kModel{"hemisphere", hemisphere_type};
constinit const PrimitiveModel CylinderPrimitive::kModel{"cylinder", cylinder_type};

PrimitiveSettings::Built CylinderPrimitive::build() const {
  return {geometry::Cylinder{{}, radius_m, math::length(axis_m), capped}, upright_to(base_m, axis_m)};
}

}  // namespace ifov::io
