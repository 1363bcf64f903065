#include "geometry/motion/moving_world.h"
#include "geometry/world.h"
#include "render/field/scene_field.h"
#include "render/mapped/map_detail.h"
#include "render/mapped/surface_maps.h"
#include "render/polarized/scene_light.h"
#include "sensor/camera.h"
#include "transport/spectral_scene.h"

// What maps say, without a search and almost without rays.

namespace ifov::render {

void SceneField::known_detail(const sampling::FieldRect& pixels, sampling::KnownDetail& detail) {
  if (flown_ != nullptr) return;
  if (map_detail_ == nullptr) map_detail_ = std::make_shared<MapDetail>(scene_.scene(), camera_);
  map_detail_->find(pixels, detail, counts_.primary);
}

std::unique_ptr<sampling::MappedSurface> SceneField::mapped_surface(sampling::Label label,
                                                                    const sampling::FocalPoint& seen) {
  if (maps_ == nullptr)
    maps_ = std::make_shared<const SurfaceMaps>(scene_, camera_, light_->columns().parts(),
                                                [this](const geometry::SurfacePoint& at, float* columns) {
                                                  if (blends_.count() > 0) blends_.write_shares(at, columns);
                                                });
  if (!maps_->any() || light_->polarized() || flown_ != nullptr) return nullptr;
  // Far enough apart to tell how texture coordinates go on, near enough to meet the same surface.
  constexpr double kApart_px = 0.01;
  points_ = {seen, seen, seen};
  points_[1].x_px += kApart_px;
  points_[2].y_px += kApart_px;
  rays_.resize(points_.size());
  hits_.resize(points_.size());
  camera_.rays(points_, rays_);
  scene_.scene().world->intersect(rays_, hits_);
  counts_.primary += points_.size();
  if (!hits_[0].hit() || !maps_->differs(hits_[0].material)) return nullptr;
  // Of what moves the rays of other lines are of other times.
  const geometry::MovingWorld* const moving = scene_.scene().world->moving();
  if (moving != nullptr && moving->is_moving(hits_[0].instance)) return nullptr;
  sampling::Label met = 0;
  find_covered(points_);
  label_hits(points_, std::span(hits_).first(1), LabelDetail::material, {&met, 1});
  // The Sun's state makes no difference to what maps say.
  if (((met ^ label) & ~sampling::Label{3}) != 0) return nullptr;
  return maps_->about(hits_, static_cast<std::size_t>(stride()));
}

}  // namespace ifov::render
