#include <algorithm>
#include <utility>

#include "render/image_renderer.h"
#include "render/mirrors/glints.h"
#include "render/mirrors/highlights.h"
#include "render/mirrors/mirror_images.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/unsampled_light.h"
#include "render/unseen/unseen_emitters.h"
#include "render/unseen/unseen_images.h"
#include "render/unseen/unseen_lobes.h"
#include "sampling/footprint_groups.h"
#include "sampling/pixel_limits.h"
#include "sampling/tile.h"

namespace ifov::render {

std::shared_ptr<const sampling::LaterLight> UnsampledLight::tell(const sampling::PixelRect& tile,
                                                                 std::size_t columns) const {
  if (job_.tolerance == nullptr ||
      (glints_ == nullptr && highlights_ == nullptr && mirror_images_ == nullptr))
    return nullptr;
  sampling::TileResult alone;
  alone.reset(tile, static_cast<int>(columns));
  add_to(alone);
  const auto lit = [](float light) { return light != 0.0f; };
  if (std::none_of(alone.mean.begin(), alone.mean.end(), lit) &&
      std::none_of(alone.half_width.begin(), alone.half_width.end(), lit))
    return nullptr;
  auto later = std::make_shared<sampling::LaterLight>();
  later->columns = columns;
  later->mean = std::move(alone.mean);
  later->half_width = std::move(alone.half_width);
  return later;
}

void UnsampledLight::add_to(sampling::TileResult& tile) const {
  const sampling::ColumnFootprints footprints(job_.footprint, job_.groups, channels_);
  if (glints_ != nullptr) glints_->add_to(footprints, job_.tolerance, tile);
  if (highlights_ != nullptr) highlights_->add_to(footprints, job_.tolerance, tile);
  if (mirror_images_ != nullptr) mirror_images_->add_to(footprints, job_.tolerance, tile);
}

void UnsampledLight::settle(sampling::TileResult& tile) const {
  if (unseen_emitters_ != nullptr) unseen_emitters_->settle(job_.tolerance, tile);
  if (unseen_images_ != nullptr) unseen_images_->settle(job_.tolerance, tile);
  if (unseen_lobes_ != nullptr) unseen_lobes_->settle(job_.tolerance, tile);
}

}  // namespace ifov::render
