#include <algorithm>
#include <utility>

#include "render/image_renderer.h"
#include "render/mirrors/glints.h"
#include "render/mirrors/highlights.h"
#include "render/mirrors/mirror_images.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/unsampled_light.h"
#include "render/unseen/unseen_bends.h"
#include "render/unseen/unseen_emitters.h"
#include "render/unseen/unseen_images.h"
#include "render/unseen/unseen_lobes.h"
#include "sampling/footprint_groups.h"
#include "sampling/intervals/quantiles.h"
#include "sampling/pixel_limits.h"
#include "sampling/tile.h"
#include "sensor/psf_wings.h"

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
  // What the footprints leave out, the wings hold.
  std::vector<double> kept;
  for (const sensor::PsfWings* wings : job_.wings) kept.push_back(wings->kept());
  if (glints_ != nullptr) glints_->add_to(footprints, job_.tolerance, tile, kept);
  if (highlights_ != nullptr) highlights_->add_to(footprints, job_.tolerance, tile, kept);
  if (mirror_images_ != nullptr) mirror_images_->add_to(footprints, job_.tolerance, tile, kept);
}

std::vector<SpotLight::Spot> UnsampledLight::spots(std::size_t columns) const {
  // The wings' intervals are those of a normal distribution.
  const double confidence = job_.tolerance != nullptr ? job_.tolerance->confidence() : 0.95;
  const double wider = sampling::two_sided_student(confidence, FocalLights::kReplicates - 1.0) /
                       sampling::two_sided_normal(confidence);
  std::vector<SpotLight::Spot> spots;
  const auto add = [&](const FocalLights& lights) {
    for (FocalLights::Distant& light : lights.distant()) {
      for (float& variance : light.variance) variance *= static_cast<float>(wider * wider);
      light.light.resize(columns);
      light.variance.resize(columns);
      spots.push_back({light.middle, 0.0, std::move(light.light), std::move(light.variance), {}});
    }
  };
  if (glints_ != nullptr) add(glints_->lights());
  if (highlights_ != nullptr) add(highlights_->lights());
  if (mirror_images_ != nullptr) add(mirror_images_->lights());
  return spots;
}

std::vector<WingSpots::Box> UnsampledLight::met() const {
  std::vector<WingSpots::Box> boxes;
  if (mirror_images_ == nullptr) return boxes;
  for (const sampling::FocalPoint& middle : mirror_images_->places(WingSpots::kMet_px)) {
    WingSpots::Box& box = boxes.emplace_back();
    box.centre = middle;
    box.half_width_px = box.half_height_px = 0.5 * MirrorImages::kPlace_px;
    box.strength = box.area_px2();
  }
  return boxes;
}

void UnsampledLight::settle(sampling::TileResult& tile) const {
  if (unseen_emitters_ != nullptr) unseen_emitters_->settle(job_.tolerance, tile);
  if (unseen_images_ != nullptr) unseen_images_->settle(job_.tolerance, tile);
  if (unseen_lobes_ != nullptr) unseen_lobes_->settle(job_.tolerance, tile);
  if (unseen_bends_ != nullptr) unseen_bends_->settle(job_.tolerance, tile);
}

}  // namespace ifov::render
