#pragma once

#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/sensor/model_error_table.h"

namespace ifov::studies {

/// What a column emits to the ground at a wavenumber along a slant (1: straight down), W m-2 sr-1 um-1, and by how much that changes
/// where every depth is less by what the table says of it. The aerosol absorbs, and scatters nothing.
struct SkyEmission {
  double radiance = 0.0, by_depth = 0.0;
};

class EmittingColumn {
 public:
  EmittingColumn(const atmosphere::AtmosphereColumn& column, const atmosphere::ModelErrorTable& table);
  SkyEmission towards_ground(double wavenumber_cm1, double slant) const;
  /// Flux down to level ground, W m-2 um-1, by Gauss nodes.
  SkyEmission flux(double wavenumber_cm1, int nodes) const;

 private:
  const atmosphere::AtmosphereColumn& column_;
  const atmosphere::ModelErrorTable& table_;
  std::vector<atmosphere::GasAmounts> amounts_;  ///< of layers
  std::vector<double> air_, water_;              ///< up to the top of each layer
};

}  // namespace ifov::studies
