#pragma once

#include <optional>
#include <vector>

#include "atmosphere/gas/gas_transmittance.h"

namespace ifov::atmosphere {

/// Absorption of a column of layers at one wavenumber as a weighted sum over terms, in each of which Beer's
/// law holds along any path: T = sum of weight exp(-sum of depth over the layers passed).
struct AbsorptionSet {
  std::vector<double> weight;              ///< sum 1
  std::vector<std::vector<double>> depth;  ///< [term][layer], vertical optical depth
  std::size_t terms() const { return weight.size(); }
};

/// The terms of the lines of all gases over the layers; one term of depth 0 where there are none. Each gas
/// has `terms` terms (3, 5 or 8), gases overlap at random, strongest first, and after each gas the products
/// are joined until `most_terms` are left. A gas that absorbs less than kGreyAbsorption over the whole column
/// is grey.
AbsorptionSet line_absorption(double wavenumber_cm1, const std::vector<GasAmounts>& layers, GasModel model,
                              int terms, int most_terms);
/// The same where the terms of some gases together are `given`: their bands (`without`) stay out, and those of the others overlap
/// with them at random.
AbsorptionSet line_absorption(double wavenumber_cm1, const std::vector<GasAmounts>& layers, GasModel model,
                              int terms, int most_terms, const std::optional<AbsorptionSet>& given,
                              const std::vector<Gas>& without);
inline constexpr double kGreyAbsorption = 0.002;

/// Random overlap: products of the terms of both, reduced to `most_terms`.
AbsorptionSet overlapped(const AbsorptionSet& first, const AbsorptionSet& second, int most_terms);

}  // namespace ifov::atmosphere
