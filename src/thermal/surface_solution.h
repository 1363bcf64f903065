#pragma once

#include <vector>

#include "thermal/cells.h"
#include "thermal/conduction.h"
#include "thermal/surface_balance.h"

namespace ifov::thermal {

struct Solid;

/// How a surface begins: in step with the mean of the first day, or all of it at the temperature of the air (THERM).
enum class Start { steady, air };

/// A surface solved over a series of outdoors, one step a row, with what it was solved from.
struct SurfaceSolution {
  Cells cells;
  SurfaceBalance balance;
  History history;
  Fluxes mean;  ///< over all steps, each with the share that the scheme took

  /// The node of a row of the series: the first step has more than one.
  std::size_t node_of_row(std::size_t row) const {
    return row == 0 ? 0 : history.nodes.size() - 1 - (rows - 1 - row);
  }
  double surface_k(std::size_t row) const { return history.nodes[node_of_row(row)].surface_k; }
  std::size_t rows = 0;
};

/// `visibility`: of the Sun, at each row; empty: 1. Throws InputError of check(solid).
SurfaceSolution solve_surface(const Solid& solid, const Skin& skin, const Stand& stand,
                              const OutdoorsSeries& series, Start start = Start::steady,
                              std::vector<double> visibility = {});

}  // namespace ifov::thermal
