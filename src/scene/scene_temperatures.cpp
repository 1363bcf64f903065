// What of a scene has a temperature: the one place where they are collected.
#include <algorithm>

#include "materials/draped_map.h"
#include "scene/heat_fluxes.h"
#include "scene/scene.h"
#include "scene/solved_temperature.h"

namespace ifov::scene {
namespace {

void include(std::optional<TemperatureRange>& range, double coldest_k, double hottest_k) {
  if (!(hottest_k > 0.0)) return;
  if (!(coldest_k > 0.0)) coldest_k = hottest_k;
  if (!range) range = TemperatureRange{coldest_k, hottest_k};
  range->coldest_k = std::min(range->coldest_k, coldest_k);
  range->hottest_k = std::max(range->hottest_k, hottest_k);
}

}  // namespace

std::optional<HeatFluxes> SolvedTemperature::fluxes(const geometry::SurfacePoint&, std::uint64_t) const {
  return std::nullopt;
}

std::optional<TemperatureRange> Scene::mapped_temperatures() const {
  std::optional<TemperatureRange> range;
  for (const SurfaceAssignment& assignment : assignments) {
    for (const auto* maps : {&assignment.temperatures, &assignment.back_temperatures})
      for (const auto& map : *maps)
        if (map) include(range, map->minimum_k(), map->maximum_k());
    for (const auto& pattern : assignment.patterns)
      if (const auto of_pattern = pattern->temperatures())
        include(range, of_pattern->coldest_k, of_pattern->hottest_k);
  }
  for (const auto& one : solved)
    if (one) include(range, one->coldest_k(), one->hottest_k());
  return range;
}

std::optional<TemperatureRange> Scene::temperatures() const {
  std::optional<TemperatureRange> range = mapped_temperatures();
  const auto one = [&](double temperature_k) { include(range, temperature_k, temperature_k); };
  for (const SurfaceState& state : states) one(state.temperature_k);
  one(surroundings.temperature_k);
  one(sky.temperature_k.value_or(0.0));
  return range;
}

bool Scene::emits(std::uint32_t state) const {
  if (states[state].temperature_k > 0.0 || states[state].lamp > 0 || states[state].solved > 0) return true;
  const std::uint32_t material = states[state].material;
  return std::any_of(assignments.begin(), assignments.end(), [&](const SurfaceAssignment& assignment) {
    for (std::size_t k = 0; k < assignment.states.size(); ++k) {
      if (assignment.states[k] == state && assignment.temperature_map(k, false)) return true;
      if (!assignment.back_states.empty() && assignment.back_states[k] == state &&
          assignment.temperature_map(k, true))
        return true;
    }
    return std::any_of(assignment.patterns.begin(), assignment.patterns.end(), [&](const auto& pattern) {
      const std::vector<std::uint32_t> mixed = pattern->mixed_materials();
      return pattern->temperatures() && std::find(mixed.begin(), mixed.end(), material) != mixed.end();
    });
  });
}

bool Scene::all_emit() const {
  if (!(surroundings.temperature_k > 0.0)) return false;
  for (std::uint32_t state = 0; state < states.size(); ++state)
    if ((!emits(state) ||
         (states[state].lamp > 0 && !(states[state].temperature_k > 0.0 || states[state].solved > 0))) &&
        !materials[states[state].material].curve_of)
      return false;
  return true;
}

}  // namespace ifov::scene
