#include "render/polarized/scene_light.h"

#include <algorithm>
#include <stdexcept>

#include "radiometry/polarization_frame.h"
#include "radiometry/spectral_nodes.h"
#include "render/parts/part_columns.h"
#include "render/polarized/polarimetry.h"
#include "sensor/camera.h"
#include "transport/parts/light_in_parts.h"
#include "transport/parts/polarized_light_in_parts.h"
#include "transport/path_light.h"
#include "transport/polarized/polarized_air.h"
#include "transport/polarized/polarized_path_light.h"
#include "transport/spectral_scene.h"
#include "transport/view_atmosphere.h"

namespace ifov::render {

namespace {

/// What part of the light the sunlight on a path's first surface is.
transport::LightPart fell_on(const transport::PathRecord& paths, std::size_t k) {
  const std::uint32_t first = paths.paths[k].first;
  return first == transport::PathVertex::kNone
             ? transport::LightPart::sun
             : transport::LightInParts::part_of_sunlight(paths.vertices[first]);
}

/// Of light towards the sensor, where Q and U are nobody's.
radiometry::PolarizationFrame any_frame(const transport::PathRecord& paths, std::size_t k) {
  return radiometry::meridional_frame(paths.paths[k].towards_sensor);
}

/// Whether unpolarized light that is sent to a vertex meets two surfaces that may polarize it, the vertex's own with them.
bool is_polarized_twice(const transport::PathRecord& paths, const transport::PathVertex& vertex, bool here) {
  constexpr std::uint32_t kNone = transport::PathVertex::kNone;
  const std::size_t own = here ? 1 : 0;
  const auto met = [&](std::uint32_t passes) {
    std::size_t count = 0;
    for (; passes != kNone; passes = paths.passes[passes].next)
      count += paths.passes[passes].segment == kNone ? 1 : 0;
    return count;
  };
  if (own + met(vertex.sun_passes) > 1 || own + met(vertex.sought_passes) > 1) return true;
  // What emits polarizes, too.
  if (vertex.sought_weight > 0.0f && vertex.sought_mixed != kNone && own + met(vertex.sought_passes) > 0)
    return true;
  for (std::uint32_t k = vertex.mirrored; k != kNone; k = paths.mirrored[k].next) {
    const transport::PathRecord::Mirrored& way = paths.mirrored[k];
    const std::size_t emits = way.emitted && way.emission_mixed != kNone ? 1 : 0;
    if (emits + own + way.count + met(way.passes) > 1) return true;
  }
  return false;
}

}  // namespace

struct SceneLight::Polarized {
  Polarized(const transport::SpectralScene& scene, bool in_parts)
      : light(scene),
        air(scene),
        parts(in_parts ? std::make_unique<transport::PolarizedLightInParts>(scene) : nullptr) {}
  transport::PolarizedPathLight light;
  transport::PolarizedAir air;
  std::unique_ptr<transport::PolarizedLightInParts> parts;  // null: as a whole
};

struct SceneLight::Changed {
  Changed(const transport::SpectralScene& scene, bool in_parts)
      : light(scene),
        parts(in_parts ? std::make_unique<transport::PolarizedLightInParts>(scene) : nullptr),
        open_sky(1, scene.node_count()) {}
  transport::PolarizedPathLight light;
  std::unique_ptr<transport::PolarizedLightInParts> parts;
  radiometry::SpectrumBlock open_sky;
  transport::PartRows rows;
};

SceneLight::SceneLight(const transport::SpectralScene& scene, const sensor::Camera& camera,
                       const LightTold& told)
    : scene_(scene),
      camera_(camera),
      light_(std::make_unique<transport::PathLight>(scene)),
      air_(std::make_unique<const transport::ViewAtmosphere>(scene)),
      polarized_(told.polarimetry != nullptr && told.polarimetry->any()
                     ? std::make_unique<Polarized>(scene, told.parts)
                     : nullptr),
      changed_(scene.polarized() && polarized_ == nullptr ? std::make_unique<Changed>(scene, told.parts)
                                                          : nullptr),
      parts_(told.parts && polarized_ == nullptr ? std::make_unique<transport::LightInParts>(scene)
                                                 : nullptr),
      columns_(told, scene.nodes()) {
  if (polarized_ != nullptr && !scene.polarized())
    throw std::invalid_argument("a sensor that tells polarization needs a scene that keeps it");
}

SceneLight::~SceneLight() = default;

bool SceneLight::is_changed(const transport::PathRecord& paths, std::size_t k) const {
  using transport::PathVertex;
  if (changed_ == nullptr) return false;
  for (auto at = static_cast<std::uint32_t>(k); at != PathVertex::kNone; at = paths.paths[at].also) {
    const transport::PathRecord::Path& path = paths.paths[at];
    std::size_t polarizing = 0;
    for (std::uint32_t v = path.first; v != PathVertex::kNone; v = paths.vertices[v].next) {
      const bool here = paths.directions[v].polarizing != nullptr;
      polarizing += here ? 1 : 0;
      if (is_polarized_twice(paths, paths.vertices[v], here)) return true;
    }
    if (polarizing > 1) return true;
    if (polarizing == 1 && path.escaped && paths.directions[path.last].polarizing != nullptr) return true;
  }
  return false;
}

float* SceneLight::radiance(const transport::PathRecord& paths, std::size_t k) {
  if (!is_changed(paths, k)) return light_->radiance(paths, k);
  float* radiance = changed_->light.light(paths, k, any_frame(paths, k))[0];
  light_->add_open_sky(paths, k, radiance);
  return radiance;
}

const transport::PartRows& SceneLight::changed_parts(const transport::PathRecord& paths, std::size_t k) {
  using transport::LightPart;
  const transport::PolarizedLightInParts::AtSensor& parts =
      changed_->parts->at_sensor(paths, k, any_frame(paths, k));
  transport::PartRows& rows = changed_->rows;
  for (std::size_t p = 0; p < transport::kRadianceParts; ++p) rows.row[p] = parts.radiance[p][0];
  rows.row[transport::kRadianceParts] = parts.transmittance;
  float* open = changed_->open_sky.row(0);
  std::fill_n(open, scene_.stride(), 0.0f);
  light_->add_open_sky(paths, k, open);
  air_->dim(paths.paths[k], open);
  for (std::size_t n = 0; n < scene_.stride(); ++n) rows[LightPart::sky][n] += open[n];
  return rows;
}

void SceneLight::to_channels(const float* radiance, float* row) const {
  scene_.nodes().to_channels(radiance, row);
}

void SceneLight::write(const transport::PathRecord& paths, std::size_t k, const sampling::FocalPoint& point,
                       const math::Ray& ray, float* row) {
  if (polarized_ != nullptr) return write_polarized(paths, k, point, ray, row);
  float* radiance = this->radiance(paths, k);
  air_->apply(paths.paths[k], radiance);
  to_channels(radiance, row);
  if (parts_ != nullptr)
    columns_.parts().write(is_changed(paths, k) ? changed_parts(paths, k) : parts_->at_sensor(paths, k), row);
}

SceneLight::Levels SceneLight::levels(const transport::PathRecord& paths, std::size_t k, bool whole) {
  const transport::PathLight::Levels light = light_->levels(paths, k, whole);
  if (whole && is_changed(paths, k)) {
    // The first part is that of light which is sent for, as it is told of paths that are not whole.
    const float* all = changed_->light.light(paths, k, any_frame(paths, k))[0];
    for (std::size_t n = 0; n < scene_.stride(); ++n) light.rest[n] = all[n] - light.direct[n];
    light_->add_open_sky(paths, k, light.rest);
  }
  air_->apply(paths.paths[k], light.direct, light.rest);
  return {light.direct, light.rest};
}

void SceneLight::write_parts(const transport::PathRecord& paths, std::size_t k, bool whole, float* direct,
                             float* rest) {
  if (parts_ == nullptr) return;
  const transport::LightInParts::Levels light = parts_->levels(paths, k, whole);
  columns_.parts().write(light.direct, direct);
  if (!whole) return;
  if (is_changed(paths, k)) {
    const transport::PartRows& all = changed_parts(paths, k);
    for (std::size_t p = 0; p < transport::kRadianceParts; ++p)
      for (std::size_t n = 0; n < scene_.stride(); ++n)
        light.rest.row[p][n] = all.row[p][n] - light.direct.row[p][n];
  }
  columns_.parts().write(light.rest, rest);
}

void SceneLight::write_polarized(const transport::PathRecord& paths, std::size_t k,
                                 const sampling::FocalPoint& point, const math::Ray& ray, float* row) {
  const radiometry::PolarizationFrame frame = sensor::focal_frame(camera_, point, ray);
  const transport::StokesRows light = polarized_->light.light(paths, k, frame);
  polarized_->air.apply(paths.paths[k], frame, light);
  columns_.write(light, row);
  if (polarized_->parts == nullptr) return;
  const transport::PolarizedLightInParts::AtSensor& parts = polarized_->parts->at_sensor(paths, k, frame);
  columns_.write_parts(parts.radiance, parts.transmittance, row);
}

void SceneLight::write_sunlight(const transport::PathRecord& paths, std::size_t k,
                                const sampling::FocalPoint& point, const math::Ray& ray, float* row) {
  if (polarized_ != nullptr) {
    const transport::StokesRows light =
        polarized_->light.first_sunlight(paths, k, sensor::focal_frame(camera_, point, ray));
    polarized_->air.see_through(paths.paths[k], light);
    columns_.write(light, row);
    return columns_.parts().write_one(fell_on(paths, k), row);
  }
  radiometry::SpectrumBlock nothing(1, scene_.node_count());
  float* radiance = is_changed(paths, k) ? changed_->light.first_sunlight(paths, k, any_frame(paths, k))[0]
                                         : light_->first_sunlight(paths, k);
  // Of what the air makes of light its own light is no part here.
  air_->apply(paths.paths[k], radiance);
  air_->apply(paths.paths[k], nothing.row(0));
  for (std::size_t n = 0; n < nothing.stride(); ++n)
    radiance[n] = std::max(0.0f, radiance[n] - nothing.row(0)[n]);
  to_channels(radiance, row);
  columns_.parts().write_one(fell_on(paths, k), row);
}

}  // namespace ifov::render
