#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "materials/numbered_map.h"

namespace ifov::materials {

/// A parameter of a scattering model by place: the value of a place is that of the cell that holds it.
class ParameterMap final : public NumberedMap {
 public:
  /// `values` row by row from the north-west corner, in the parameter's SI unit; throws InputError unless there are width x
  /// height of them and the cells have a size.
  ParameterMap(MapGrid grid, std::vector<float> values);
  double at(const MapPosition& position) const {
    return static_cast<double>(values_[grid_.cell_at(position)]);
  }
  float number(std::size_t cell) const override { return values_[cell]; }

 private:
  std::vector<float> values_;
};

/// A parameter from a map, and the values at which its model is made.
struct ParameterAxis {
  std::shared_ptr<const ParameterMap> map;
  std::vector<double> levels;  ///< rising, one or more
};

}  // namespace ifov::materials
