#include "materials/parameter_map.h"

#include <utility>

namespace ifov::materials {

ParameterMap::ParameterMap(MapGrid grid, std::vector<float> values)
    : NumberedMap(grid), values_(std::move(values)) {
  check(grid_, values_.size(), "a map of a parameter");
  find_blocks();
}

}  // namespace ifov::materials
