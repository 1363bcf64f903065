#include "atmosphere/column/tabulated_gases.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/band_model.h"
#include "atmosphere/gas/column_terms.h"
#include "atmosphere/gas/continua.h"
#include "atmosphere/gas/gas_term_table.h"
#include "atmosphere/gas/gas_transmittance.h"

namespace ifov::atmosphere {
namespace {

std::optional<std::size_t> bin_of_terms(const AtmosphereColumn& column, double wavenumber_cm1) {
  return column.terms() != nullptr ? column.terms()->table().bin_at(wavenumber_cm1) : std::nullopt;
}

}  // namespace

std::optional<TabulatedGases> tabulated_gases(const AtmosphereColumn& column, double wavenumber_cm1,
                                              double otherwise) {
  const std::optional<std::size_t> bin = bin_of_terms(column, wavenumber_cm1);
  if (!bin) return std::nullopt;
  return TabulatedGases{column.terms()->at(*bin), column.terms()->off_at(*bin, otherwise)};
}

double band_transmittance(const AtmosphereColumn& column, double wavenumber_cm1, const GasAmounts& amounts) {
  const GasModel model = column.description().gas_model;
  ContinuumDepths continuum = continuum_depths(wavenumber_cm1, amounts, model);
  const bool within = bin_of_terms(column, wavenumber_cm1).has_value();
  if (within) column.terms()->leave_out(continuum);
  const std::vector<Gas> tabulated = within ? column.terms()->gases() : std::vector<Gas>();
  double depth = continuum.total();
  for (const ActiveBand& active : active_bands(wavenumber_cm1, model))
    if (std::find(tabulated.begin(), tabulated.end(), BandModel::instance().bands()[active.band].gas) ==
        tabulated.end())
      depth += std::pow(active.coefficient * amounts.band[active.band], active.a);
  return std::exp(-depth);
}

}  // namespace ifov::atmosphere
