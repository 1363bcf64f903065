#pragma once

#include <memory>
#include <vector>

#include "core/format.h"
#include "geometry/world/world_builder.h"
#include "materials/bsdf/lambertian.h"
#include "radiometry/spectral_nodes.h"
#include "scene/scene.h"
#include "transport/path_light.h"
#include "transport/path_tracer.h"
#include "transport/spectral_scene.h"
#include "transport/view_atmosphere.h"

namespace ifov::test {

/// A scene made of a few shapes, seen in one monochromatic channel.
class SmallScene {
 public:
  static constexpr double kWavelength_um = 10.0;

  std::uint32_t material(
      double reflectance, double temperature_k = 0.0,
      const std::shared_ptr<const materials::Bsdf>& bsdf = materials::Lambertian::shared()) {
    materials::Material material;
    material.name = format("m{}", scene_.materials.size());
    material.reflectance = radiometry::Spectrum::constant(reflectance);
    material.bsdf = bsdf;
    const auto index = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(material);
    scene_.states.push_back({index, temperature_k});
    scene::SurfaceAssignment assignment;
    assignment.states = {index};
    scene_.assignments.push_back(assignment);
    // The other side of a boundary is a material of its own.
    if (const std::shared_ptr<const materials::Bsdf> behind = bsdf->behind()) {
      const std::uint32_t back = this->material(reflectance, temperature_k, behind);
      scene_.assignments[index].back_states = {back};
    }
    return index;
  }

  std::uint32_t leaf(double reflectance, double transmittance, double temperature_k = 0.0) {
    const std::uint32_t index = material(reflectance, temperature_k);
    scene_.materials[index].transmittance = radiometry::Spectrum::constant(transmittance);
    return index;
  }

  void place(geometry::Shape shape, std::uint32_t material, const math::Transform& transform = {}) {
    const geometry::ShapeId id = builder_.add_shape(std::move(shape));
    const std::vector<std::uint32_t> materials(builder_.slot_count(id), material);
    builder_.place(id, transform, materials);
  }

  void sun(math::Vec3 direction, double irradiance, double half_angle_rad) {
    scene::Sun sun;
    sun.direction = math::normalized(direction);
    sun.half_angle_rad = half_angle_rad;
    sun.irradiance = radiometry::Spectrum::constant(irradiance);
    scene_.sun = sun;
  }

  void sky(double radiance) { scene_.sky.radiance = radiometry::Spectrum::constant(radiance); }

  /// `wrap`: makes another world of the one that was placed.
  template <class Wrap>
  const transport::SpectralScene& build(const Wrap& wrap) {
    scene_.world = wrap(place());
    return build_spectra();
  }
  const transport::SpectralScene& build() {
    scene_.world = place();
    return build_spectra();
  }
  /// Whose paths tell the polarization of their light.
  const transport::SpectralScene& build_polarized() {
    scene_.world = place();
    return build_spectra(true);
  }

 private:
  std::unique_ptr<geometry::World> place() {
    geometry::BuildOptions options{.threads = 1};
    options.surveyed = scene_.mirror_assignments();
    options.lobes = scene_.lobe_assignments();
    return builder_.build(options);
  }
  const transport::SpectralScene& build_spectra(bool polarized = false) {
    material(0.0);  // the surroundings
    scene_.surroundings = scene_.states.back();
    std::vector<radiometry::Spectrum> surfaces;
    for (const auto& m : scene_.materials) {
      surfaces.push_back(m.reflectance);
      if (m.transmittance) surfaces.push_back(*m.transmittance);
    }
    const std::vector<radiometry::Channel> channels = {
        radiometry::Channel::monochromatic("only", kWavelength_um)};
    nodes_ = std::make_unique<radiometry::SpectralNodes>(radiometry::SpectralNodes::build(
        channels, scene_.sun ? scene_.sun->irradiance : radiometry::Spectrum(), surfaces));
    spectral_ = std::make_unique<transport::SpectralScene>(scene_, *nodes_, polarized);
    return *spectral_;
  }

 public:
  struct Estimate {
    double mean = 0.0, standard_error = 0.0;
  };

  /// Mean over `count` paths along one ray.
  Estimate radiance(const math::Ray& ray, std::uint32_t count, std::uint64_t sequence = 1,
                    transport::TransportOptions options = {}) const {
    transport::PathTracer tracer(*spectral_, options);
    std::vector<math::Ray> rays(count, ray);
    std::vector<transport::PathKey> keys(count);
    for (std::uint32_t k = 0; k < count; ++k) keys[k] = {sequence, k};
    std::vector<geometry::SurfacePoint> hits(count);
    sampling::RayCounts counts;
    transport::PathLight light(*spectral_);
    const transport::ViewAtmosphere air(*spectral_);
    const transport::PathRecord& paths = tracer.trace(rays, keys, hits, counts);
    std::vector<double> values;
    for (std::uint32_t k = 0; k < count; ++k) {
      float* radiance = light.radiance(paths, k);
      air.apply(paths.paths[k], radiance);
      values.push_back(static_cast<double>(radiance[0]));
    }
    double sum = 0.0, square = 0.0;
    for (const double value : values) sum += value;
    const double mean = sum / count;
    for (const double value : values) square += (value - mean) * (value - mean);
    return {mean, std::sqrt(square / (count - 1.0) / count)};
  }

  scene::Scene& scene() { return scene_; }

 private:
  scene::Scene scene_;
  geometry::WorldBuilder builder_;
  std::unique_ptr<radiometry::SpectralNodes> nodes_;
  std::unique_ptr<transport::SpectralScene> spectral_;
};

}  // namespace ifov::test
