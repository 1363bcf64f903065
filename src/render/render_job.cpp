#include "render/image_renderer.h"
#include "sampling/footprint_groups.h"

namespace ifov::render {

double RenderJob::reach_px() const {
  return groups != nullptr ? groups->half_width_px() : footprint.half_width_px();
}

}  // namespace ifov::render
