#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world.h"
#include "materials/bsdf/bsdf.h"
#include "materials/bsdf/narrow_lobes.h"
#include "materials/draped_map.h"
#include "scene/cut_out.h"
#include "scene/lamp.h"
#include "scene/solved_temperature.h"
#include "scene/temperature_scope.h"

namespace ifov::scene {

double Sun::zenith_rad() const { return std::atan2(std::hypot(direction.x, direction.y), direction.z); }
double Sun::elevation_rad() const { return std::atan2(direction.z, std::hypot(direction.x, direction.y)); }
bool Sun::is_twilight() const {
  constexpr double kLowest_rad = 6.0 * std::numbers::pi / 180.0;
  return !is_moon && !is_up() && elevation_rad() >= -kLowest_rad * (1.0 + 1e-12);
}
double Sun::azimuth_rad() const { return std::atan2(direction.x, direction.y); }

bool SurfaceAssignment::mixes_materials() const {
  return std::any_of(patterns.begin(), patterns.end(), [](const auto& p) { return p->mixes_materials(); });
}

bool SurfaceAssignment::bends_normals() const {
  return std::any_of(patterns.begin(), patterns.end(), [](const auto& p) { return p->bends_normals(); });
}

std::vector<const materials::NumberedMap*> SurfaceAssignment::maps() const {
  std::vector<const materials::NumberedMap*> all;
  if (classes) all.push_back(classes.get());
  if (cut_out) cut_out->add_maps(all);
  for (const auto* of : {&temperatures, &back_temperatures})
    for (const auto& map : *of)
      if (map) all.push_back(map.get());
  for (const auto& pattern : patterns) pattern->add_maps(all);
  // Each once, where it came first: the order of addresses would differ from run to run.
  std::vector<const materials::NumberedMap*> once;
  for (const materials::NumberedMap* map : all)
    if (std::find(once.begin(), once.end(), map) == once.end()) once.push_back(map);
  return once;
}

const materials::TemperatureMap* SurfaceAssignment::temperature_map(std::size_t index, bool inner) const {
  const auto& maps = inner && !back_temperatures.empty() ? back_temperatures : temperatures;
  return maps.empty() ? nullptr : maps[index].get();
}

Scene::Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;
Scene::Scene(const Scene&) = default;

const Lamp* Scene::lamp_of(std::uint32_t state) const {
  const std::uint32_t lamp = states[state].lamp;
  return lamp > 0 ? &lamps[lamp - 1] : nullptr;
}

namespace {

/// By assignment, whether it may show a material of which `is` holds; empty where none does.
template <class Is>
std::vector<bool> assignments_showing(const Scene& scene, const Is& is) {
  std::vector<bool> showing;
  for (const SurfaceAssignment& assignment : scene.assignments) {
    // Curves of a texture scatter as the material of the state does that they replace.
    const auto shows = [&](std::uint32_t state) { return is(scene.states[state].material); };
    bool any = std::any_of(assignment.states.begin(), assignment.states.end(), shows) ||
               std::any_of(assignment.back_states.begin(), assignment.back_states.end(), shows);
    for (const auto& pattern : assignment.patterns) {
      const std::vector<std::uint32_t> brought = pattern->mixed_materials();
      any = any || std::any_of(brought.begin(), brought.end(), is);
      for (std::uint32_t s = 0; s < scene.states.size() && !any; ++s) {
        const std::vector<std::uint32_t> replacing = pattern->replacing(s);
        any = std::any_of(replacing.begin(), replacing.end(), shows);
      }
      if (pattern->mixes_materials() && brought.empty())
        for (std::uint32_t m = 0; m < scene.materials.size(); ++m) any = any || is(m);
    }
    showing.push_back(any);
  }
  if (std::find(showing.begin(), showing.end(), true) == showing.end()) showing.clear();
  return showing;
}

}  // namespace

std::vector<bool> Scene::mirror_assignments() const {
  return assignments_showing(*this,
                             [&](std::uint32_t material) { return materials[material].bsdf->is_delta(); });
}

std::vector<bool> Scene::lobe_assignments() const {
  return assignments_showing(
      *this, [&](std::uint32_t material) { return materials::has_narrow_lobe(*materials[material].bsdf); });
}

ResolvedSurface Scene::resolve(const geometry::SurfacePoint& point, std::uint64_t draw, double share) const {
  ResolvedSurface surface = resolve_without_temperature(point);
  if (!solved.empty()) solve(point, draw, share, surface);
  return surface;
}

void Scene::solve(const geometry::SurfacePoint& point, std::uint64_t draw, double share,
                  ResolvedSurface& surface) const {
  std::uint32_t known = 0;
  EstimatedTemperature estimate;
  for (std::size_t k = 0; k < surface.count; ++k) {
    Constituent& part = surface.constituents[k];
    const std::uint32_t by = states[part.state].solved;
    if (by == 0) continue;
    TemperatureScope* const scope = TemperatureScope::current();
    if (by != known)
      estimate = scope != nullptr ? scope->answer(by - 1, point, draw, share)
                                  : solved[by - 1]->at(point, draw, share);
    known = by;
    part.mapped_temperature_k = estimate.kelvin;
    part.deviation_k = estimate.deviation_k;
    part.else_k = static_cast<float>(estimate.else_k);
    part.times = static_cast<float>(estimate.times);
    part.else_deviation_k = static_cast<float>(estimate.else_deviation_k);
  }
}

ResolvedSurface Scene::resolve_without_temperature(const geometry::SurfacePoint& point) const {
  if ((point.copy_column | point.copy_row) == 0) return resolve_own(point);
  // Maps lie on the cell and repeat with it.
  const geometry::World::Period period = world->period().value_or(geometry::World::Period{});
  geometry::SurfacePoint own = point;
  own.position_m =
      point.position_m - math::Vec3{point.copy_column * period.x_m, point.copy_row * period.y_m, 0.0};
  own.copy_column = own.copy_row = 0;
  return resolve_own(own);
}

ResolvedSurface Scene::resolve_own(const geometry::SurfacePoint& point) const {
  const SurfaceAssignment& assignment = assignments[point.material];
  ResolvedSurface surface;
  surface.count = 1;
  surface.shading_normal = point.shading_normal;
  Constituent& only = surface.constituents[0];
  const materials::MapPosition position{point.position_m.x, point.position_m.y, point.u, point.v};
  const std::uint32_t index = assignment.classes ? assignment.classes->at(position) : std::uint16_t{0};
  const bool behind = !point.front && !assignment.back_states.empty();
  only.state = behind ? assignment.back_states[index] : assignment.states[index];
  only.material = states[only.state].material;
  only.weight = 1.0;
  only.mapped_temperature_k = 0.0;
  only.deviation_k = 0.0;
  only.times = 1.0f;
  only.else_deviation_k = 0.0f;
  if (const materials::TemperatureMap* map = assignment.temperature_map(index, behind))
    only.mapped_temperature_k = map->at_k(position);
  for (const auto& pattern : assignment.patterns) pattern->apply(point, surface);
  return surface;
}

TruthMaterials truth_materials(const Scene& scene) {
  TruthMaterials truth;
  for (const materials::Material& material : scene.materials) {
    truth.of_material.push_back(static_cast<std::uint32_t>(truth.names.size()));
    if (!material.curve_of) truth.names.push_back(material.name);
  }
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    if (scene.materials[m].curve_of) truth.of_material[m] = truth.of_material[*scene.materials[m].curve_of];
  return truth;
}

}  // namespace ifov::scene
