#include "session/assembly/whole/surroundings_assembly.h"

#include <algorithm>
#include <map>
#include <vector>

#include "core/format.h"
#include "geometry/world.h"
#include "io/document/atmosphere_document.h"
#include "io/document/light_document.h"
#include "materials/bsdf/bsdf.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "session/assembly/whole/camera_grid.h"

namespace ifov::session {
namespace {

constexpr int kAcross = 24;        // rays along each side of the image
constexpr int kAcrossChunks = 8;   // where each place that is met has a tree of its own to be made
constexpr std::size_t kNamed = 3;  // materials that the note names
/// Share of ground that reflects by direction from which on the note says what it is taken for.
constexpr double kToldByDirection = 0.5;

/// What of the ground is made of which material, and how warm that is.
struct Ground {
  std::map<std::uint32_t, double> share;  // by material
  double area = 0.0, warm_area = 0.0, temperature_sum = 0.0;

  void add(const scene::Scene& scene, const geometry::SurfacePoint& point) {
    for (const scene::Constituent& part : scene.resolve(point)) {
      share[part.material] += part.weight;
      area += part.weight;
      const double temperature_k = part.mapped_temperature_k > 0.0 ? part.mapped_temperature_k
                                                                   : scene.states[part.state].temperature_k;
      if (!(temperature_k > 0.0)) continue;
      warm_area += part.weight;
      temperature_sum += part.weight * temperature_k;
    }
  }
};

/// As the camera sees it where it looks down, from above where it looks at walls.
Ground ground_in_view(const scene::Scene& scene, const sensor::Camera& camera) {
  const geometry::World& world = *scene.world;
  const std::vector<geometry::SurfacePoint> seen =
      hits_of_camera(world, camera, world.storage().chunks > 0 ? kAcrossChunks : kAcross);
  const double above_m = world.heights().high_m + 1.0;
  std::vector<math::Ray> down;
  for (const geometry::SurfacePoint& point : seen)
    if (point.hit())
      down.push_back({{point.position_m.x, point.position_m.y, std::max(above_m, point.position_m.z + 1.0)},
                      {0.0, 0.0, -1.0}});
  std::vector<geometry::SurfacePoint> hits(down.size());
  world.intersect(down, hits);
  Ground ground;
  for (const geometry::SurfacePoint& point : hits)
    if (point.hit()) ground.add(scene, point);
  return ground;
}

radiometry::Spectrum mean_reflectance(const scene::Scene& scene, const Ground& ground) {
  std::vector<const radiometry::Spectrum*> spectra;
  for (const auto& [material, area] : ground.share) spectra.push_back(&scene.materials[material].reflectance);
  const auto mean_at = [&](double um) {
    double mean = 0.0;
    for (const auto& [material, area] : ground.share)
      mean += area / ground.area * scene.materials[material].reflectance.at(um);
    return std::clamp(mean, 0.0, 1.0);
  };
  radiometry::CommonWavelengths common = radiometry::common_wavelengths(spectra);
  if (common.um.empty()) {
    constexpr double kAny_um = 1.0;
    return radiometry::Spectrum::constant(mean_at(kAny_um));
  }
  std::vector<double> values;
  for (const double um : common.um) values.push_back(mean_at(um));
  return {std::move(common.um), std::move(values), common.outside, "mean reflectance of the ground"};
}

}  // namespace

std::optional<std::string> assume_surroundings(const io::LightDocument& light,
                                               const io::AtmosphereDocument& atmosphere,
                                               const sensor::Camera& camera, scene::Scene& scene) {
  if (light.surroundings || !(atmosphere.modelled || atmosphere.imported)) return std::nullopt;
  const Ground ground = ground_in_view(scene, camera);
  if (!(ground.area > 0.0)) return std::nullopt;
  materials::Material& around = scene.materials[scene.surroundings.material];
  around.reflectance = mean_reflectance(scene, ground);
  if (2.0 * ground.warm_area > ground.area) {
    scene.surroundings.temperature_k = ground.temperature_sum / ground.warm_area;
    around.temperature_k = scene.surroundings.temperature_k;
  }
  std::map<std::string, double> by_name;
  for (const auto& [material, area] : ground.share) {
    const materials::Material& found = scene.materials[material];
    by_name[found.curve_of ? scene.materials[*found.curve_of].name : found.name] += area / ground.area;
  }
  double by_direction = 0.0;
  for (const auto& [material, area] : ground.share)
    if (!scene.materials[material].bsdf->is_lambertian()) by_direction += area / ground.area;
  std::vector<std::pair<double, std::string>> parts;
  for (const auto& [name, share] : by_name) parts.emplace_back(-share, name);
  std::sort(parts.begin(), parts.end());
  std::string names;
  for (std::size_t k = 0; k < std::min(kNamed, parts.size()); ++k)
    names += format("{}{:.0f} % '{}'", k == 0 ? "" : ", ", -100.0 * parts[k].first, parts[k].second);
  if (parts.size() > kNamed) names += format(" and {} more", parts.size() - kNamed);
  return format(
      "surroundings: none declared; taken as the mean of the ground in the picture ({}), {}{}", names,
      scene.surroundings.temperature_k > 0.0 ? format("at {:.1f} K", scene.surroundings.temperature_k)
                                             : std::string("which emits nothing"),
      by_direction > kToldByDirection
          ? "; it is taken to reflect alike in every direction, which 'light.surroundings' with a 'material' need not"
          : "");
}

}  // namespace ifov::session
