#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace ifov::benchmarks {

/// A document by chance whose temperatures are solved: a place, an hour and two days of weather (low Sun, night, cloud, wind, gaps in what
/// is told); materials of the library, of layers and backs, wet ones, heated ones, thin ones, a class map; boxes, walls, decks,
/// cars that come and go, trees, sheets, roofs that slope.
struct WildThermal {
  std::string text;  ///< of the document
  std::string kind;  ///< what stands in it, in a few words
  double reach_m = 0.0,
         top_m = 0.0;  ///< where surfaces are worth looking at: |x| and |y|, and z, up to these
};
/// Its weather and maps are written to `folder`.
WildThermal wild_thermal(std::uint64_t seed, const std::filesystem::path& folder);

}  // namespace ifov::benchmarks
