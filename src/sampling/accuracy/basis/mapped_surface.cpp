#include "sampling/accuracy/basis/mapped_surface.h"

#include <memory>

#include "sampling/field.h"

namespace ifov::sampling {

std::unique_ptr<MappedSurface> Field::mapped_surface(Label, const FocalPoint&) { return nullptr; }

void Field::known_detail(const FieldRect& pixels, KnownDetail& detail) {
  detail.points.clear();
  detail.standouts.clear();
  detail.full.assign(
      static_cast<std::size_t>(pixels.x1 - pixels.x0) * static_cast<std::size_t>(pixels.y1 - pixels.y0), 0);
}

}  // namespace ifov::sampling
