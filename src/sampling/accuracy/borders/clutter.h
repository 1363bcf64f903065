#pragma once

#include <cmath>

namespace ifov::sampling {

/// Rays that stratified sampling needs in a pixel with borders of the given length (px) for one allowed
/// standard error: its error is 0.46 contrast sqrt(length) n^(-3/4) for n points one to a cell (contrast in
/// allowed standard errors), since only the cells that a border crosses err.
inline double stratified_cost(double contrast, double border_length_px) {
  return std::pow(0.46 * contrast * std::sqrt(border_length_px), 4.0 / 3.0);
}

/// Rays that tracing needs: about this many for each lattice side with unlike ends, with those that find out that a
/// pixel is clutter after all (5 where every border is simple).
constexpr double kTracingCostPerCrossing = 10.0;

/// Fewer stratified rays than this never say anything about their own error.
constexpr double kFewestStratified = 32.0;

/// How much tracing a pixel may cost: a pixel that has had more label rays than `part` of its stratified rays, and at least `fewest`, holds
/// more borders than its lattice announced.
struct TracingBudget {
  double part, fewest;
};
/// Where borders make the error, and where values of a label differ besides, of which tracing saves none.
constexpr TracingBudget kOfBorders{1.5, 400.0}, kOfValues{0.75, 150.0};
/// The lattice may have met a border where it is short: it counts as so long at least.
constexpr double kLeastBorder_px = 2.0;

/// Mean number of lattice sides crossed by a border of length 1 px on a lattice of spacing 1 / k: 4 k / pi.
inline double crossings_per_length(int lattice) { return 1.27 * lattice; }

}  // namespace ifov::sampling
