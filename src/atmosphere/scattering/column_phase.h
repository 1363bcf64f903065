#pragma once

#include <cstddef>
#include <vector>

#include "atmosphere/scattering/phase/phase_expansion.h"
#include "atmosphere/scattering/scattering_column.h"

namespace ifov::atmosphere {

/// Phase matrices of the column's layers, expanded, times half their single-scattering albedo and delta-M
/// scaled.
struct ColumnPhase {
  int terms = 0;  ///< coefficients that are not zero everywhere
  std::size_t sublayers = 0;
  std::vector<double> beta, alpha, zeta, gamma;  ///< [l][sublayer]
  ColumnPhase(const ScatteringColumn& column, const AerosolProjection& aerosol, int most_terms);
  const double* at(const std::vector<double>& table, int l) const { return table.data() + l * sublayers; }
};

}  // namespace ifov::atmosphere
