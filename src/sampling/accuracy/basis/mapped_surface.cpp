#include "sampling/accuracy/basis/mapped_surface.h"

#include <memory>

#include "sampling/field.h"

namespace ifov::sampling {

std::unique_ptr<MappedSurface> Field::mapped_surface(Label, const FocalPoint&) { return nullptr; }

}  // namespace ifov::sampling
