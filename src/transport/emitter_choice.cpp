#include "transport/emitter_choice.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "geometry/world.h"
#include "materials/bsdf/bsdf.h"
#include "materials/draped_map.h"
#include "scene/scene.h"
#include "scene/solved_temperature.h"
#include "transport/spectral_scene.h"

namespace ifov::transport {

namespace {

/// Contrast with what does not shine at all.
constexpr double kEndless = 1e30;

/// The value that half of the weight lies at or below.
double median(std::vector<std::pair<double, double>> value_and_weight) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double whole = 0.0, below = 0.0;
  for (const auto& [value, weight] : value_and_weight) whole += weight;
  for (const auto& [value, weight] : value_and_weight)
    if ((below += weight) >= 0.5 * whole) return value;
  return 0.0;
}

}  // namespace

EmitterChoice::EmitterChoice(const SpectralScene& scene, double contrast, bool shown)
    : scene_(scene),
      wanted_(scene.scene().assignments.size(), false),
      mapped_(scene.scene().assignments.size(), false),
      declined_(scene.scene().assignments.size(), false),
      said_(scene.scene().assignments.size(), false),
      lamp_(scene.scene().assignments.size(), false),
      contrast_(scene.scene().assignments.size(), 0.0),
      wanted_in_(scene.scene().assignments.size(), std::vector<bool>(scene.nodes().channel_count(), false)),
      brightest_(scene.scene().assignments.size()),
      group_of_(scene.nodes().channel_count(), 0),
      unit_(scene.nodes().channel_count(), 0.0),
      usual_(scene.nodes().channel_count(), std::numeric_limits<double>::quiet_NaN()) {
  if (!scene.scene().world) return;
  list_surfaces();
  find_contrasts(contrast, shown);
}

std::vector<double> EmitterChoice::channels(const float* nodes) const {
  std::vector<double> means(scene_.nodes().channel_count(), 0.0);
  for (std::size_t c = 0; c < means.size(); ++c)
    for (std::size_t n = scene_.nodes().first_node(c); n < scene_.nodes().first_node(c + 1); ++n)
      means[c] += scene_.nodes().node_weight(n) * static_cast<double>(nodes[n]);
  return means;
}

void EmitterChoice::list_surfaces() {
  const scene::Scene& scene = scene_.scene();
  std::vector<float> spectrum(scene_.node_count());
  const auto range_of = [&](const scene::SurfaceState& state, const materials::TemperatureMap* map) {
    if (state.solved > 0)
      return scene::TemperatureRange{scene.solved[state.solved - 1]->coldest_k(),
                                     scene.solved[state.solved - 1]->hottest_k()};
    return map != nullptr ? scene::TemperatureRange{map->minimum_k(), map->maximum_k()}
                          : scene::TemperatureRange{state.temperature_k, state.temperature_k};
  };
  const auto add = [&](std::uint32_t assignment, std::uint32_t material, double coldest_k, double hottest_k,
                       const float* lamp = nullptr, bool patterned = false) {
    Surface surface;
    surface.assignment = assignment;
    surface.said = scene.materials[material].emitter;
    surface.lamp = lamp != nullptr;
    surface.events = scene_.brightest(material) > 0.0 && !scene.materials[material].bsdf->is_delta();
    const auto emitted = [&](double temperature_k, const float* light) {
      std::fill(spectrum.begin(), spectrum.end(), 0.0f);
      if (temperature_k > 0.0) scene_.nodes().planck(temperature_k, std::span<float>(spectrum));
      for (std::size_t n = 0; n < spectrum.size(); ++n)
        spectrum[n] = spectrum[n] * scene_.materials().emissivity(material)[n] + (light ? light[n] : 0.0f);
      return channels(spectrum.data());
    };
    surface.hottest = emitted(hottest_k, lamp);
    surface.coldest = coldest_k == hottest_k && !patterned ? surface.hottest
                                                           : emitted(coldest_k, patterned ? nullptr : lamp);
    for (std::size_t n = 0; n < spectrum.size(); ++n)
      spectrum[n] =
          scene_.materials().reflectance(material)[n] + scene_.materials().transmittance(material)[n];
    surface.albedo = channels(spectrum.data());
    surfaces_.push_back(std::move(surface));
  };
  for (std::uint32_t c = 0; c < scene.assignments.size(); ++c) {
    const scene::SurfaceAssignment& assignment = scene.assignments[c];
    mapped_[c] = assignment.classes || !assignment.temperatures.empty() || !assignment.patterns.empty();
    for (std::size_t k = 0; k < assignment.states.size(); ++k) {
      const scene::SurfaceState& state = scene.states[assignment.states[k]];
      const auto* map = assignment.temperature_map(k, false);
      const float* lamp = scene_.lamp_radiance(assignment.states[k]);
      const bool patterned = scene_.lamp_pattern(assignment.states[k]) != nullptr;
      const auto [coldest_k, hottest_k] = range_of(state, map);
      add(c, state.material, coldest_k, hottest_k, lamp, patterned);
      for (const auto& pattern : assignment.patterns)
        for (const std::uint32_t other : pattern->replacing(assignment.states[k]))
          add(c, scene.states[other].material, coldest_k, hottest_k, lamp, patterned);
      if (assignment.back_states.empty() || assignment.back_states[k] == assignment.states[k]) continue;
      const scene::SurfaceState& back = scene.states[assignment.back_states[k]];
      const auto* back_map = assignment.temperature_map(k, true);
      const auto [back_coldest_k, back_hottest_k] = range_of(back, back_map);
      add(c, back.material, back_coldest_k, back_hottest_k);
      for (const auto& pattern : assignment.patterns)
        for (const std::uint32_t other : pattern->replacing(assignment.back_states[k]))
          add(c, scene.states[other].material, back_coldest_k, back_hottest_k);
    }
    for (const auto& pattern : assignment.patterns) {
      const auto range = pattern->temperatures();
      if (!range) continue;
      std::vector<std::uint32_t> mixed = pattern->mixed_materials();
      if (mixed.empty()) {
        mixed.resize(scene.materials.size());
        std::iota(mixed.begin(), mixed.end(), 0u);
      }
      for (const std::uint32_t material : mixed) add(c, material, range->coldest_k, range->hottest_k);
    }
  }
}

void EmitterChoice::find_contrasts(double contrast, bool shown) {
  for (const Surface& s : surfaces_)
    for (std::size_t c = 0; c < unit_.size(); ++c) unit_[c] = std::max(unit_[c], s.hottest[c]);
  // A white surface that faces the Sun, under the sky.
  std::vector<double> lit = channels(scene_.sky_radiance());
  if (scene_.scene().sun && scene_.scene().sun->is_up()) {
    const std::vector<double> sun = channels(scene_.sun_irradiance());
    for (std::size_t c = 0; c < lit.size(); ++c) lit[c] += sun[c] / std::numbers::pi;
  }
  const auto needed = [&](const Surface& s) { return shown && s.lamp ? kShown : contrast; };
  // Areas are asked for where the coldest surface alone would do.
  std::vector<double> areas;
  for (std::size_t c = 0; c < unit_.size(); ++c) {
    double coldest = unit_[c];
    for (const Surface& s : surfaces_) coldest = std::min(coldest, s.coldest[c]);
    if (std::none_of(surfaces_.begin(), surfaces_.end(),
                     [&](const Surface& s) { return s.hottest[c] > needed(s) * std::max(lit[c], coldest); }))
      continue;
    if (areas.empty()) areas = scene_.scene().world->surface_areas_m2(wanted_.size());
    std::vector<std::size_t> parts(wanted_.size(), 0);
    for (const Surface& s : surfaces_) ++parts[s.assignment];
    std::vector<std::pair<double, double>> levels;
    for (const Surface& s : surfaces_)
      levels.emplace_back(s.coldest[c], areas[s.assignment] / static_cast<double>(parts[s.assignment]));
    const double usual = usual_[c] = std::max(lit[c], median(std::move(levels)));
    for (const Surface& s : surfaces_) {
      if (!(s.hottest[c] > needed(s) * usual) || areas[s.assignment] <= 0.0) continue;
      const bool wanted = !shown || std::any_of(surfaces_.begin(), surfaces_.end(), [&](const Surface& r) {
        return r.events && areas[r.assignment] > 0.0 &&
               r.albedo[c] * s.hottest[c] > kShown * (r.coldest[c] + r.albedo[c] * lit[c]);
      });
      if (!wanted) continue;
      wanted_[s.assignment] = any_ = wanted_in_[s.assignment][c] = true;
      contrast_[s.assignment] =
          std::max(contrast_[s.assignment], usual > 0.0 ? s.hottest[c] / usual : kEndless);
    }
  }
  for (const Surface& s : surfaces_) {
    if (s.lamp) lamp_[s.assignment] = true;
    if (s.said == false) declined_[s.assignment] = wanted_[s.assignment];
    if (!shown || s.said != true || wanted_[s.assignment] ||
        std::none_of(s.hottest.begin(), s.hottest.end(), [](double radiance) { return radiance > 0.0; }))
      continue;
    wanted_[s.assignment] = said_[s.assignment] = any_ = true;
    wanted_in_[s.assignment].assign(unit_.size(), true);
    contrast_[s.assignment] = std::max(contrast_[s.assignment], 1.0);
  }
  group_channels();
  for (const Surface& s : surfaces_) {
    const GroupedRadiance radiance = grouped(s.assignment, s.hottest);
    for (std::size_t g = 0; g < groups_; ++g)
      brightest_[s.assignment].of[g] = std::max(brightest_[s.assignment].of[g], radiance.of[g]);
  }
}

/// Channels go to the group whose first channel is most like them, or found one.
void EmitterChoice::group_channels() {
  // Shares of the brightest below the least are nothing; shares within the factor are alike.
  constexpr double kLeast = 1e-8, kAlike = 4.0;
  const auto share = [&](const Surface& s, std::size_t c) {
    return wanted_in_[s.assignment][c] ? std::max(s.hottest[c] / unit_[c], kLeast) : kLeast;
  };
  const auto unlikeness = [&](std::size_t c, std::size_t d) {
    double worst = 1.0;
    for (const Surface& s : surfaces_)
      if (wanted_[s.assignment])
        worst = std::max({worst, share(s, c) / share(s, d), share(s, d) / share(s, c)});
    return worst;
  };
  std::vector<std::size_t> firsts;
  for (std::size_t c = 0; c < unit_.size() && any_; ++c) {
    if (std::none_of(surfaces_.begin(), surfaces_.end(),
                     [&](const Surface& s) { return wanted_in_[s.assignment][c]; }))
      continue;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t g = 0; g < firsts.size(); ++g)
      if (const double unlike = unlikeness(c, firsts[g]); unlike < least) least = unlike, group_of_[c] = g;
    if (least <= kAlike || firsts.size() == GroupedRadiance::kMost) continue;
    group_of_[c] = firsts.size();
    firsts.push_back(c);
  }
  groups_ = std::max<std::size_t>(1, firsts.size());
}

std::vector<double> EmitterChoice::highest(std::uint32_t assignment) const {
  std::vector<double> highest(unit_.size(), 0.0);
  for (const Surface& s : surfaces_)
    for (std::size_t c = 0; c < highest.size() && s.assignment == assignment; ++c)
      highest[c] = std::max(highest[c], s.hottest[c]);
  return highest;
}

GroupedRadiance EmitterChoice::grouped(std::uint32_t assignment,
                                       const std::vector<double>& by_channel) const {
  GroupedRadiance mean;
  std::array<double, GroupedRadiance::kMost> count{};
  for (const std::size_t group : group_of_) ++count[group];
  for (std::size_t c = 0; c < unit_.size(); ++c)
    if (wanted_in_[assignment][c]) mean.of[group_of_[c]] += by_channel[c] / unit_[c] / count[group_of_[c]];
  return mean;
}

GroupedRadiance EmitterChoice::brightness(std::uint32_t assignment, const float* emission) const {
  return emission == nullptr ? GroupedRadiance{} : grouped(assignment, channels(emission));
}

}  // namespace ifov::transport
