#include "landscape/landscapes.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "io/document/schema/quantity.h"

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

double size_m_of(const std::string& text) {
  const auto quantity = io::split_quantity(text);
  const io::Unit* unit = quantity ? io::kLength.find(quantity->unit) : nullptr;
  if (unit == nullptr)
    throw InputError(format("ifov: --size is '{}', expected a length such as 200m (units: {})", text,
                            io::kLength.unit_list()));
  return quantity->number * unit->factor;
}

}  // namespace ifov::landscape
