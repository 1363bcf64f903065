#include "landscape/landscapes.h"

#include <algorithm>
#include <array>

namespace ifov::landscape {
namespace {

constexpr std::array kLandscapes{
    LandscapeEntry{"suburb",
                   "streets, houses and gardens, leaf-level trees, a tennis court, cars, a power line",
                   make_suburb},
    LandscapeEntry{"forest", "a mixed forest on hills, glades, a track, shrubs, rocks, fallen trunks",
                   make_forest},
    LandscapeEntry{"desert", "dunes and gravel plains, shrubs, rocks, a track with vehicles, a small camp",
                   make_desert},
    LandscapeEntry{"harbour", "water and a quay with ships, cranes, containers, sheds, rails and lorries",
                   make_harbour},
};

}  // namespace

std::span<const LandscapeEntry> all_landscapes() { return kLandscapes; }

const LandscapeEntry* find_landscape(std::string_view name) {
  const auto found = std::find_if(kLandscapes.begin(), kLandscapes.end(),
                                  [&](const LandscapeEntry& entry) { return entry.name == name; });
  return found == kLandscapes.end() ? nullptr : &*found;
}

}  // namespace ifov::landscape
