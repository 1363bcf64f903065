#pragma once

#include <memory>
#include <vector>

namespace ifov::thermal {

struct Solid;
struct TimeTable;

/// How finely a solid is cut: the first cell in daily depths of its solid, how much deeper each next one is in the same
/// measure, and the number of parts that each is cut into. `parts` halves cells along one smooth curve of depth, so that
/// the error falls with their square.
struct CellSizes {
  double first_daily_depths = 1.0 / 60.0;
  double growth = 1.15;
  int parts = 1;
};

/// A solid cut into finite volumes, from the surface inwards: the surface and the back are nodes without mass.
struct Cells {
  std::vector<double> depth_m;             ///< of the cells' middles
  std::vector<double> capacity_j_m2_k;     ///< of each cell
  std::vector<double> conductance_w_m2_k;  ///< from the surface to the first cell, from cell to cell
  double back_conductance_w_m2_k = 0.0;    ///< from the last cell to what is behind; 0 where insulated
  double back_temperature_k = 0.0;
  std::shared_ptr<const TimeTable> back_over_time{};  ///< in place of that; null: it is that
};

/// Each layer is an integer number of cells. Throws InputError as check(solid) does.
Cells cut_into_cells(const Solid& solid, const CellSizes& sizes = {});

}  // namespace ifov::thermal
