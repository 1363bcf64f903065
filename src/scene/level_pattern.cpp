#include "scene/level_pattern.h"

#include <algorithm>
#include <array>

#include "geometry/surface_point.h"

namespace ifov::scene {
namespace {

/// Shares too small for a weight above 0 in single precision are none.
constexpr double kLeastShare = 1e-6;

struct Between {
  std::size_t low = 0;
  double share = 0.0;  ///< of the level above
};

Between between(const std::vector<double>& levels, double value) {
  if (value <= levels.front()) return {};
  if (value >= levels.back()) return {levels.size() - 1, 0.0};
  const auto low =
      static_cast<std::size_t>(std::upper_bound(levels.begin(), levels.end(), value) - levels.begin()) - 1;
  const double share = (value - levels[low]) / (levels[low + 1] - levels[low]);
  if (share < kLeastShare) return {low, 0.0};
  if (share > 1.0 - kLeastShare) return {low + 1, 0.0};
  return {low, share};
}

}  // namespace

LevelPattern::LevelPattern(std::uint32_t state, std::uint32_t states_of,
                           std::vector<materials::ParameterAxis> axes, std::vector<Member> members)
    : state_(state), states_of_(states_of), axes_(std::move(axes)), members_(std::move(members)) {}

std::vector<std::uint32_t> LevelPattern::replacing(std::uint32_t state) const {
  std::vector<std::uint32_t> states;
  if (state == states_of_)
    for (const Member& member : members_) states.push_back(member.state);
  return states;
}

void LevelPattern::apply(const geometry::SurfacePoint& point, ResolvedSurface& surface) const {
  static_assert(ResolvedSurface::kMost >= 4);
  const std::size_t before = surface.count;
  const materials::MapPosition position{point.position_m.x, point.position_m.y, point.u, point.v};
  for (std::size_t k = 0; k < before; ++k) {
    if (surface.constituents[k].state != state_) continue;
    const Constituent whole = surface.constituents[k];
    struct Part {
      std::size_t member = 0;
      double share = 1.0;
    };
    std::array<Part, 4> parts{};
    std::size_t count = 1;
    for (const materials::ParameterAxis& axis : axes_) {
      const Between place = between(axis.levels, axis.map->at(position));
      const std::size_t known = count;
      for (std::size_t p = 0; p < known; ++p) {
        const Part part = parts[p];
        parts[p] = {part.member * axis.levels.size() + place.low, part.share * (1.0 - place.share)};
        if (place.share > 0.0)
          parts[count++] = {part.member * axis.levels.size() + place.low + 1, part.share * place.share};
      }
    }
    for (std::size_t p = 0; p < count; ++p) {
      const Member& member = members_[parts[p].member];
      Constituent& target = p == 0 ? surface.constituents[k] : surface.constituents[surface.count++];
      target = {member.state, member.material, whole.weight * parts[p].share, whole.mapped_temperature_k};
    }
  }
}

void LevelPattern::add_maps(std::vector<const materials::NumberedMap*>& maps) const {
  for (const materials::ParameterAxis& axis : axes_) maps.push_back(axis.map.get());
}

}  // namespace ifov::scene
