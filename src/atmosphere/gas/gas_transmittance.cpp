#include "atmosphere/gas/gas_transmittance.h"

#include <cmath>

#include "atmosphere/gas/band_model.h"

namespace ifov::atmosphere {
namespace {

double exponent_of(const Band& band, GasModel model) {
  constexpr int kLastStrongBandCm1 = 2700;
  constexpr double kStrongBandExponent = 0.7201;
  const bool slipped =
      model == GasModel::lowtran7 && band.gas == Gas::n2o && band.first_cm1 > kLastStrongBandCm1;
  return slipped ? kStrongBandExponent : band.a;
}

double transmittance_of(const ActiveBand& active, const GasAmounts& amounts) {
  return std::exp(-std::pow(active.coefficient * amounts.band[active.band], active.a));
}

}  // namespace

std::vector<ActiveBand> active_bands(double wavenumber_cm1, GasModel model) {
  const std::vector<Band>& bands = BandModel::instance().bands();
  const int grid = band_grid_cm1(wavenumber_cm1);
  std::vector<ActiveBand> active;
  for (std::size_t b = 0; b < bands.size(); ++b)
    if (bands[b].covers(grid)) active.push_back({b, bands[b].at(grid), exponent_of(bands[b], model)});
  return active;
}

double line_transmittance(Gas gas, double wavenumber_cm1, const GasAmounts& amounts, GasModel model) {
  double transmittance = 1.0;
  for (const ActiveBand& active : active_bands(wavenumber_cm1, model))
    if (BandModel::instance().bands()[active.band].gas == gas)
      transmittance *= transmittance_of(active, amounts);
  return transmittance;
}

double gas_transmittance(double wavenumber_cm1, const GasAmounts& amounts, GasModel model) {
  double transmittance = std::exp(-continuum_depths(wavenumber_cm1, amounts, model).total());
  for (const ActiveBand& active : active_bands(wavenumber_cm1, model))
    transmittance *= transmittance_of(active, amounts);
  return transmittance;
}

}  // namespace ifov::atmosphere
