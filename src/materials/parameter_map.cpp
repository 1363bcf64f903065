#include "materials/parameter_map.h"

#include <utility>

namespace ifov::materials {

ParameterMap::ParameterMap(MapGrid grid, std::vector<float> values)
    : grid_(grid), values_(std::move(values)) {
  check(grid_, values_.size(), "a map of a parameter");
}

}  // namespace ifov::materials
