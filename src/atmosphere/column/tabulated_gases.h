#pragma once

#include <optional>

#include "atmosphere/gas/term_overlap.h"

namespace ifov::atmosphere {

class AtmosphereColumn;
struct GasAmounts;

/// What gases of a table of terms absorb, by term and layer, and what of that may be too much.
struct TabulatedGases {
  AbsorptionSet lines, off;
};

/// In the bin that a wavenumber lies in: off as the table says, or `otherwise` of the depth. None without a table, or outside its bins.
std::optional<TabulatedGases> tabulated_gases(const AtmosphereColumn& column, double wavenumber_cm1,
                                              double otherwise);

/// Transmittance of amounts along some path, by bands and continua: of all gases but those of the column's table of terms where that has
/// a bin.
double band_transmittance(const AtmosphereColumn& column, double wavenumber_cm1, const GasAmounts& amounts);

}  // namespace ifov::atmosphere
