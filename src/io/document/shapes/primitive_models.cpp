#include <array>

#include "io/document/shapes/box_primitive.h"
#include "io/document/shapes/flat_primitives.h"
#include "io/document/shapes/primitive.h"
#include "io/document/shapes/round_primitives.h"

namespace ifov::io {
namespace {

constexpr std::array kModels{
    &PlanePrimitive::kModel,      &BoxPrimitive::kModel,      &SpherePrimitive::kModel,
    &HemispherePrimitive::kModel, &CylinderPrimitive::kModel, &DiskPrimitive::kModel,
    &PolygonPrimitive::kModel,
};

}  // namespace

std::span<const PrimitiveModel* const> primitive_models() { return kModels; }

bool is_primitive(const ShapeDocument& shape, const PrimitiveModel& model) {
  const auto* primitive = std::get_if<PrimitiveShape>(&shape);
  return primitive != nullptr && primitive->model == model.key;
}

}  // namespace ifov::io
