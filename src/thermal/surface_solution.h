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

  /// Of a steady start: over how many rows gains were averaged, and kelvins of its surface per W m-2 of that mean; else 0.
  std::size_t start_rows = 0;
  double start_k_per_w_m2 = 0.0;
};

/// `visibility`: of the Sun, at each row; empty: 1. `free_sky`: at each row in place of the stand's; empty: that. `beside`: as
/// SurfaceBalance. Throws InputError of check(solid).
SurfaceSolution solve_surface(const Solid& solid, const Skin& skin, const Stand& stand,
                              const OutdoorsSeries& series, Start start = Start::steady,
                              std::vector<double> visibility = {}, std::vector<double> free_sky = {},
                              std::vector<FromBeside> beside = {});

/// linear_kernel() of the last row, by row of the series: those of the first step go to the rows beside them, and what a gain of
/// the first day does by way of a steady start counts there.
std::vector<double> kernel_by_row(const SurfaceSolution& solution);

}  // namespace ifov::thermal
