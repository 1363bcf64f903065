#include "atmosphere/gas/term_overlap.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "atmosphere/gas/band_model.h"
#include "atmosphere/gas/term_joining.h"

namespace ifov::atmosphere {
namespace {

AbsorptionSet grey(const std::vector<double>& depth) { return {{1.0}, {depth}}; }

AbsorptionSet terms_of(const ActiveBand& active, const std::vector<GasAmounts>& layers, double column,
                       int terms) {
  const double x = active.coefficient * column;
  const double exponent = std::pow(x, active.a);
  std::vector<double> depth(layers.size());
  for (std::size_t l = 0; l < layers.size(); ++l) depth[l] = active.coefficient * layers[l].band[active.band];
  const auto times = [&](double factor) {
    std::vector<double> scaled = depth;
    for (double& d : scaled) d *= factor;
    return scaled;
  };
  if (1.0 - std::exp(-exponent) < kGreyAbsorption) return grey(times(x > 0.0 ? exponent / x : 0.0));
  const AbsorptionTerms& fit = absorption_terms(active.a, terms);
  AbsorptionSet set{fit.weight, {}};
  for (const double k : fit.k) set.depth.push_back(times(k));
  return set;
}

/// -ln of what the whole column transmits.
double column_depth(const AbsorptionSet& set) {
  constexpr double kOpaque = 1e-300;
  double transmittance = 0.0;
  for (std::size_t t = 0; t < set.terms(); ++t)
    transmittance +=
        set.weight[t] * std::exp(-std::accumulate(set.depth[t].begin(), set.depth[t].end(), 0.0));
  return -std::log(std::max(kOpaque, transmittance));
}

/// Factor for the mean depth of a group with which it transmits along the vertical what its members do: the
/// mean alone transmits too little. Near 1; 1 where the group lets next to nothing through.
double share_kept(const AbsorptionSet& set, const TermGroup& group, const std::vector<double>& mean) {
  const double depth = std::accumulate(mean.begin(), mean.end(), 0.0);
  constexpr double kOpaque = 4.0;
  if (depth <= 0.0 || depth > kOpaque) return 1.0;
  double transmittance = 0.0;
  for (const std::size_t member : group.members)
    transmittance += set.weight[member] / group.weight *
                     std::exp(-std::accumulate(set.depth[member].begin(), set.depth[member].end(), 0.0));
  return -std::log(transmittance) / depth;
}

}  // namespace

AbsorptionSet overlapped(const AbsorptionSet& first, const AbsorptionSet& second, int most_terms) {
  AbsorptionSet product;
  for (std::size_t i = 0; i < first.terms(); ++i)
    for (std::size_t j = 0; j < second.terms(); ++j) {
      product.weight.push_back(first.weight[i] * second.weight[j]);
      product.depth.push_back(first.depth[i]);
      for (std::size_t l = 0; l < product.depth.back().size(); ++l)
        product.depth.back()[l] += second.depth[j][l];
    }
  if (product.terms() <= static_cast<std::size_t>(most_terms)) return product;
  AbsorptionSet reduced;
  for (const TermGroup& group :
       joined_terms(product.weight, product.depth, static_cast<std::size_t>(most_terms))) {
    std::vector<double> mean(product.depth[0].size());
    for (const std::size_t member : group.members)
      for (std::size_t l = 0; l < mean.size(); ++l)
        mean[l] += product.weight[member] / group.weight * product.depth[member][l];
    const double kept = share_kept(product, group, mean);
    for (double& depth : mean) depth *= kept;
    reduced.weight.push_back(group.weight);
    reduced.depth.push_back(std::move(mean));
  }
  return reduced;
}

AbsorptionSet line_absorption(double wavenumber_cm1, const std::vector<GasAmounts>& layers, GasModel model,
                              int terms, int most_terms) {
  return line_absorption(wavenumber_cm1, layers, model, terms, most_terms, std::nullopt, {});
}

AbsorptionSet line_absorption(double wavenumber_cm1, const std::vector<GasAmounts>& layers, GasModel model,
                              int terms, int most_terms, const std::optional<AbsorptionSet>& given,
                              const std::vector<Gas>& without) {
  struct Contribution {
    double exponent = 0.0;
    AbsorptionSet set;
  };
  std::vector<Contribution> gases;
  if (given) gases.push_back({column_depth(*given), *given});
  for (const ActiveBand& active : active_bands(wavenumber_cm1, model)) {
    const Gas gas = BandModel::instance().bands()[active.band].gas;
    if (std::find(without.begin(), without.end(), gas) != without.end()) continue;
    double column = 0.0;
    for (const GasAmounts& layer : layers) column += layer.band[active.band];
    gases.push_back(
        {std::pow(active.coefficient * column, active.a), terms_of(active, layers, column, terms)});
  }
  std::stable_sort(gases.begin(), gases.end(),
                   [](const Contribution& a, const Contribution& b) { return a.exponent > b.exponent; });
  AbsorptionSet total = grey(std::vector<double>(layers.size(), 0.0));
  for (const Contribution& gas : gases) total = overlapped(total, gas.set, most_terms);
  return total;
}

}  // namespace ifov::atmosphere
