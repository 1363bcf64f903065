#include "materials/opacity_map.h"

#include <algorithm>
#include <utility>

namespace ifov::materials {

OpacityMap::OpacityMap(MapGrid grid, std::vector<bool> open) : NumberedMap(grid), open_(std::move(open)) {
  check(grid_, open_.size(), "an opacity map");
  find_blocks();
}

double OpacityMap::open_share() const {
  return static_cast<double>(std::count(open_.begin(), open_.end(), true)) /
         static_cast<double>(open_.size());
}

}  // namespace ifov::materials
