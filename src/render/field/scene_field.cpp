#include "render/field/scene_field.h"

#include <algorithm>

#include "geometry/world.h"
#include "materials/bsdf/bsdf.h"
#include "render/polarized/scene_light.h"
#include "sensor/camera.h"
#include "transport/mirror_light.h"
#include "transport/mirrors/sun_disc.h"
#include "transport/path_tracer.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

SceneField::SceneField(const transport::SpectralScene& scene, const sensor::Camera& camera,
                       transport::TransportOptions transport, LabelDetail detail, const LightTold& told)
    : scene_(scene),
      camera_(camera),
      detail_(detail),
      tracer_(std::make_unique<transport::PathTracer>(scene, transport)),
      light_(std::make_unique<SceneLight>(scene, camera, told)),
      truth_(scene::truth_materials(scene.scene())),
      moving_(find_moving(scene.scene(), camera)),
      flown_(find_flown(scene.scene(), camera)),
      blends_(scene.scene(), truth_, static_cast<int>(light_->columns().count()),
              moving_ != nullptr || flown_ != nullptr),
      unseen_(scene, blends_.first_column() + blends_.count()),
      through_(scene),
      mirror_light_(
          detail == LabelDetail::sun_state
              ? transport::MirrorLight::find(scene, tracer_->sun_images(), transport.mirror_reflections)
              : nullptr) {
  if (scene.scene().sun)
    disc_points_ =
        transport::fixed_disc_points(scene.scene().sun->direction, scene.scene().sun->half_angle_rad);
  const std::vector<materials::Material>& materials = scene.scene().materials;
  for (std::uint32_t m = 0; m < materials.size(); ++m)
    sunlight_.push_back({scene.brightest(m) > 0.0 && !materials[m].bsdf->is_delta(),
                         scene.materials().maximum_transmittance(m) > 0.0f});
}

SceneField::~SceneField() = default;

int SceneField::leader(int column) const { return light_->columns().leader(column); }

int SceneField::channel_of(int column) const {
  return column < blends_.first_column() ? light_->columns().channel_of(column) : -1;
}

void SceneField::settle(sampling::TileResult& tile) const { light_->columns().settle(tile); }

std::uint32_t SceneField::object_of(sampling::Label label) const {
  const bool sky = SurfaceLabel::material_of(label) == SurfaceLabel::kSky;
  return sky || scene_.scene().world->object_count() > SurfaceLabel::kMaximumInstances
             ? kNoObject
             : SurfaceLabel::instance_of(label);
}

std::uint32_t SceneField::material_of(sampling::Label label) const {
  const std::uint32_t material = SurfaceLabel::material_of(label);
  if (material == SurfaceLabel::kBlend) return BlendColumns::kNoMaterial;
  return material == SurfaceLabel::kSky ? truth_.of_material[scene_.scene().surroundings.material] : material;
}

void SceneField::values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
                        std::span<float> values) {
  this->values(requests, labels, values, detail_, {});
}

void SceneField::values_expecting(std::span<const sampling::PathRequest> requests,
                                  std::span<const sampling::Label> expected,
                                  std::span<sampling::Label> labels, std::span<float> values) {
  this->values(requests, labels, values, detail_, expected);
}

void SceneField::values_and_materials(std::span<const sampling::PathRequest> requests,
                                      std::span<sampling::Label> labels, std::span<float> values) {
  this->values(requests, labels, values, LabelDetail::material, {});
}

void SceneField::values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
                        std::span<float> values, LabelDetail detail,
                        std::span<const sampling::Label> expected) {
  if (flown_ != nullptr) return flown_values(requests, labels, values, detail, expected);
  if (moving_ != nullptr) return moving_values(requests, labels, values, detail);
  if (shared_ != nullptr) return shared_->values(*this, requests, labels, values);
  const std::size_t row_length = static_cast<std::size_t>(stride());
  for (std::size_t first = 0; first < requests.size(); first += kMostTraced) {
    const std::size_t count = std::min(kMostTraced, requests.size() - first);
    const transport::PathRecord& paths = trace_paths(requests.subspan(first, count));
    for (std::size_t k = 0; k < count; ++k) write(*this, paths, k, values.data() + (first + k) * row_length);
    label_hits(points_, hits_, detail, labels.subspan(first, count),
               expected.empty() ? expected : expected.subspan(first, count), &paths);
  }
}

bool SceneField::values_in_shadow(std::span<const sampling::PathRequest> requests, std::span<float> values) {
  if (flown_ != nullptr || moving_ != nullptr || shared_ != nullptr) return false;
  const std::size_t row_length = static_cast<std::size_t>(stride());
  for (std::size_t first = 0; first < requests.size(); first += kMostTraced) {
    const std::size_t count = std::min(kMostTraced, requests.size() - first);
    transport::PathRecord paths = trace_paths(requests.subspan(first, count));
    for (transport::PathVertex& vertex : paths.vertices) vertex.sun_weight = 0.0f;
    for (std::size_t k = 0; k < count; ++k) write(*this, paths, k, values.data() + (first + k) * row_length);
  }
  return true;
}

const transport::PathRecord& SceneField::trace_paths(std::span<const sampling::PathRequest> requests) {
  const std::size_t count = requests.size();
  points_.resize(count);
  keys_.resize(count);
  rays_.resize(count);
  hits_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    points_[k] = requests[k].point;
    keys_[k] = {requests[k].sequence, requests[k].index};
  }
  camera_.rays(points_, rays_);
  const transport::PathRecord& paths = tracer_->trace(rays_, keys_, hits_, counts_);
  find_covered(points_);
  return paths;
}

const transport::PathRecord& SceneField::trace(std::span<const sampling::PathRequest> requests,
                                               std::span<sampling::Label> labels) {
  const transport::PathRecord& paths = trace_paths(requests);
  label_hits(points_, hits_, detail_, labels);
  return paths;
}

void SceneField::write(const SceneField& by, const transport::PathRecord& paths, std::size_t k, float* row) {
  light_->write(paths, k, by.points_[k], by.rays_[k], row);
  if ((by.moving_ != nullptr || by.flown_ != nullptr) && by.covered_[k] != 0)
    blends_.write_shares(by.hits_[k], row, true);
  else if (blends_.count() > 0)
    blends_.write_shares(by.hits_[k], row);
  unseen_.write(paths.paths[k], row);
}

}  // namespace ifov::render
