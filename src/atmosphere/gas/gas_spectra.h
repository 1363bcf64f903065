#pragma once

#include <cstddef>
#include <vector>

#include "atmosphere/gas/gas_term_table.h"

namespace ifov::atmosphere {

/// Absorption cross sections of one gas, line by line: at rising wavenumbers, for every state of a grid.
struct GasSpectra {
  TermGas gas = {};
  std::vector<double> wavenumber_cm1;
  StateGrid states;
  std::vector<std::vector<float>> log_k;  ///< [state][wavenumber], ln cm2 per molecule
};

/// The points that lie in a bin or next to its edges, and the share of the bin that each stands for: what is nearer to it than
/// to its neighbours.
struct BinPoints {
  std::size_t first = 0;
  std::vector<double> share;  ///< sum 1; of points first, first + 1 ...
};
BinPoints points_in(const std::vector<double>& wavenumber_cm1, double from_cm1, double to_cm1);

}  // namespace ifov::atmosphere
