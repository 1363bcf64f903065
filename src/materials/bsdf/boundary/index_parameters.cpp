#include "materials/bsdf/boundary/index_parameters.h"

#include "core/error.h"
#include "core/format.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"

namespace ifov::materials {

void refuse_name(const BsdfInputs& inputs, std::string_view key, std::string_view n, std::string_view k) {
  if (inputs.has(key))
    throw InputError(format(
        "'{}' is '{}': the built-in table tells what a surface reflects, not how little is absorbed on a way "
        "through; give '{}' and '{}'",
        key, inputs.word(key), n, k));
}

void apply_factor(const radiometry::Spectrum& factor, std::size_t rows,
                  std::vector<radiometry::Spectrum>& shares) {
  if (factor.is_constant() && factor.at(1.0) == 1.0) return;
  for (std::size_t row = 0; row < rows; ++row) {
    const radiometry::Spectrum both[] = {shares[row], factor};
    shares[row] = combined(both, [](std::span<const double> v) { return v[0] * v[1]; });
  }
}

}  // namespace ifov::materials
