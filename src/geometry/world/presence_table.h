#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/presence.h"

namespace ifov::geometry {

/// Which objects are there for a time only. Objects that are placed together share an entry.
struct PresenceTable {
  static constexpr std::uint32_t kAlways = 0xffffffffu;
  struct Run {
    std::uint32_t first_object = 0;
    std::uint32_t presence = kAlways;  ///< index into `presences`
  };
  std::vector<Presence> presences;
  std::vector<Run> runs;  ///< by their first object; the first begins with object 0

  /// Null: always.
  const Presence* of(std::uint32_t object) const {
    const auto after = std::upper_bound(runs.begin(), runs.end(), object,
                                        [](std::uint32_t o, const Run& run) { return o < run.first_object; });
    const std::uint32_t index = after == runs.begin() ? kAlways : (after - 1)->presence;
    return index == kAlways ? nullptr : &presences[index];
  }
};

}  // namespace ifov::geometry
