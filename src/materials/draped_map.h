#pragma once

#include <cstdint>
#include <vector>

namespace ifov::materials {

/// Where a raster lies on the scene, seen from above: square or oblong cells, rows from north (large y) to
/// south.
struct MapGrid {
  double west_m = 0.0;   ///< x of the left edge
  double north_m = 0.0;  ///< y of the upper edge
  double cell_width_m = 1.0, cell_height_m = 1.0;
  int width = 0, height = 0;
};

/// Class numbers draped from above: the class at (x, y) is that of the cell that holds it. A cell holds its
/// west and north edges; positions outside take the nearest cell.
class ClassMap {
 public:
  /// `classes` row by row from the north-west corner; throws InputError unless there are width x height of
  /// them and the cells have a size.
  ClassMap(MapGrid grid, std::vector<std::uint16_t> classes);
  std::uint16_t at(double x_m, double y_m) const;
  const MapGrid& grid() const { return grid_; }
  std::uint16_t largest_class() const;

 private:
  MapGrid grid_;
  std::vector<std::uint16_t> classes_;
};

/// Temperatures draped from above, bilinear between the centres of cells; positions outside take the nearest
/// edge.
class TemperatureMap {
 public:
  /// As ClassMap; temperatures in kelvins, all above 0.
  TemperatureMap(MapGrid grid, std::vector<float> temperature_k);
  double at_k(double x_m, double y_m) const;
  const MapGrid& grid() const { return grid_; }
  double minimum_k() const;
  double maximum_k() const;

 private:
  MapGrid grid_;
  std::vector<float> temperature_k_;
};

}  // namespace ifov::materials
