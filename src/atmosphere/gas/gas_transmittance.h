#pragma once

#include "atmosphere/gas/continua.h"

namespace ifov::atmosphere {

/// A band at work at a wavenumber.
struct ActiveBand {
  std::size_t band = 0;      ///< index into BandModel::bands()
  double coefficient = 0.0;  ///< 10^C'
  double a = 0.0;
};

/// The bands that cover a wavenumber, at most one a gas. In the lowtran7 model the bands of nitrous oxide
/// beyond 2700 cm-1 have the exponent 0.7201 of those below, which that program uses although the
/// coefficients belong to 0.6933.
std::vector<ActiveBand> active_bands(double wavenumber_cm1, GasModel model);

/// Transmittance of the lines of one gas in closed form, exp(-(10^C' W)^a).
double line_transmittance(Gas gas, double wavenumber_cm1, const GasAmounts& amounts, GasModel model);

/// Of all lines and continua.
double gas_transmittance(double wavenumber_cm1, const GasAmounts& amounts, GasModel model);

}  // namespace ifov::atmosphere
