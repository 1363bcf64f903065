#include "atmosphere/gas/column_terms.h"

#include "core/error.h"
#include "core/format.h"

namespace ifov::atmosphere {

ColumnTerms::ColumnTerms(std::shared_ptr<const GasTermTable> table, const Profile& profile,
                         const std::vector<double>& altitude_km)
    : table_(std::move(table)) {
  const StateGrid& states = table_->states;
  for (const TermGas& of : table_->gases) {
    Layered gas{layer_gas(profile, of, altitude_km), {}};
    const OutsideGrid out = outside(states, gas.layers, altitude_km);
    if (out.share > kMostOutside)
      throw InputError(format(
          "the gas model {} is of another air: it holds {:g} to {:g} hPa and {:g} to {:g} K, and {:.3g} % of "
          "this air's {} lies outside, most of it about {:.2g} km, at {:.4g} hPa and {:.4g} K",
          table_->name, states.pressure_hPa().front(), states.pressure_hPa().back(),
          states.temperature_K().front(), states.temperature_K().back(), 100.0 * out.share,
          kGasNames[static_cast<std::size_t>(of.gas)], out.altitude_km, out.pressure_hPa, out.temperature_K));
    for (const LayerGas& layer : gas.layers)
      gas.places.push_back(states.place(layer.pressure_hPa, layer.temperature_K));
    gases_.push_back(std::move(gas));
  }
}

std::vector<Gas> ColumnTerms::gases() const {
  std::vector<Gas> all;
  for (const TermGas& of : table_->gases) all.push_back(of.gas);
  return all;
}

/// Of the depths of each gas times its factor.
template <class Factor>
AbsorptionSet ColumnTerms::sum(std::size_t bin, const Factor& factor) const {
  const TermBin& here = table_->bins[bin];
  const std::size_t layers = gases_.front().layers.size();
  if (here.weight.empty()) return {{1.0}, {std::vector<double>(layers, 0.0)}};
  AbsorptionSet set{here.weight, std::vector(here.terms(), std::vector<double>(layers, 0.0))};
  for (std::size_t g = 0; g < gases_.size(); ++g) {
    const double of_gas = factor(table_->gases[g]);
    for (std::size_t l = 0; l < layers; ++l) {
      const std::vector<double> k = here.cross_sections(g, gases_[g].places[l]);
      for (std::size_t t = 0; t < k.size(); ++t)
        set.depth[t][l] += of_gas * k[t] * gases_[g].layers[l].molecules_cm2;
    }
  }
  return set;
}

AbsorptionSet ColumnTerms::at(std::size_t bin) const {
  return sum(bin, [](const TermGas&) { return 1.0; });
}

AbsorptionSet ColumnTerms::off_at(std::size_t bin, double otherwise) const {
  return sum(bin, [&](const TermGas& gas) { return gas.depth_error.value_or(otherwise); });
}

void ColumnTerms::leave_out(ContinuumDepths& depths) const {
  for (const TermGas& gas : table_->gases) {
    if (!gas.holds_continuum) continue;
    if (gas.gas == Gas::h2o) depths.water = 0.0;
    if (gas.gas == Gas::o3) depths.ozone = 0.0;
    if (gas.gas == Gas::no2) depths.nitrogen_dioxide = 0.0;
    if (gas.gas == Gas::o2) depths.oxygen = depths.oxygen_pairs = 0.0;
  }
}

}  // namespace ifov::atmosphere
