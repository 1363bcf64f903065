#include "materials/bsdf/boundary/index_parameters.h"

#include "materials/bsdf/microfacet/fresnel_rows.h"

namespace ifov::materials {

void apply_factor(const radiometry::Spectrum& factor, std::size_t rows,
                  std::vector<radiometry::Spectrum>& shares) {
  if (factor.is_constant() && factor.at(1.0) == 1.0) return;
  for (std::size_t row = 0; row < rows; ++row) {
    const radiometry::Spectrum both[] = {shares[row], factor};
    shares[row] = combined(both, [](std::span<const double> v) { return v[0] * v[1]; });
  }
}

}  // namespace ifov::materials
