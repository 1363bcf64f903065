#include "sampling/field.h"

#include "sampling/accuracy/basis/mapped_surface.h"
#include "sampling/known_detail.h"

namespace ifov::sampling {

RayCounts& RayCounts::operator+=(const RayCounts& other) {
  primary += other.primary;
  shadow += other.shadow;
  continuation += other.continuation;
  return *this;
}

void Field::values_expecting(std::span<const PathRequest> requests, std::span<const Label>,
                             std::span<Label> labels, std::span<float> values) {
  this->values(requests, labels, values);
}

void Field::values_and_materials(std::span<const PathRequest> requests, std::span<Label> labels,
                                 std::span<float> values) {
  this->values(requests, labels, values);
}

std::unique_ptr<MappedSurface> Field::mapped_surface(Label, const FocalPoint&) { return nullptr; }

void Field::known_detail(const FieldRect& pixels, KnownDetail& detail) {
  detail.points.clear();
  detail.standouts.clear();
  detail.full.assign(
      static_cast<std::size_t>(pixels.x1 - pixels.x0) * static_cast<std::size_t>(pixels.y1 - pixels.y0), 0);
}

}  // namespace ifov::sampling
