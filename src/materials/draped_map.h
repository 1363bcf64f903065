#pragma once

#include <cstdint>
#include <vector>

#include "materials/numbered_map.h"

namespace ifov::materials {

/// Class numbers: the class of a place is that of the cell that holds it.
class ClassMap final : public NumberedMap {
 public:
  /// `classes` row by row from the north-west corner; throws InputError unless there are width x height of
  /// them and the cells have a size.
  ClassMap(MapGrid grid, std::vector<std::uint16_t> classes);
  std::uint16_t at(const MapPosition& position) const { return classes_[grid_.cell_at(position)]; }
  std::uint16_t at(double x_m, double y_m) const { return at(MapPosition{x_m, y_m}); }
  float number(std::size_t cell) const override { return classes_[cell]; }
  std::uint16_t largest_class() const;

 private:
  std::vector<std::uint16_t> classes_;
};

/// Temperatures, bilinear between the middles of cells.
class TemperatureMap final : public NumberedMap {
 public:
  static constexpr double kHottest_k = 1e5;

  /// As ClassMap; temperatures in kelvins. Throws InputError, which names row and column, where one is not above 0 or
  /// above kHottest_k.
  TemperatureMap(MapGrid grid, std::vector<float> temperature_k);
  double at_k(const MapPosition& position) const;
  double at_k(double x_m, double y_m) const { return at_k(MapPosition{x_m, y_m}); }
  float number(std::size_t cell) const override { return temperature_k_[cell]; }
  double minimum_k() const;
  double maximum_k() const;

 private:
  std::vector<float> temperature_k_;
};

}  // namespace ifov::materials
