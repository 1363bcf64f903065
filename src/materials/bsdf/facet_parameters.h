#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/microfacet/facet_distribution.h"

namespace ifov::materials {

/// What models of facets ask for in the same words.

/// "ggx", "beckmann".
std::span<const std::string_view> facet_shapes();
FacetShape facet_shape(const BsdfInputs& inputs);

/// A width of the distribution of facets. Throws InputError below the least of a model whose lobe can be widened
/// (Bsdf::widened_lobe), or of any other, and points to the mirror.
double facet_width(const BsdfInputs& inputs, std::string_view key, bool widens = true);

/// Keys of a distribution of two widths, beside 'roughness'.
BsdfParameter across_parameter();
BsdfParameter direction_parameter();
struct FacetWidths {
  double along = 0.0, across = 0.0;  ///< the direction
};
FacetWidths facet_widths(const BsdfInputs& inputs);

/// The keys of a complex index, 'index' or 'n' and 'k', before others of a model; refractive_index() reads them.
std::vector<BsdfParameter> with_index(std::vector<BsdfParameter> others);

struct IndexSpectra {
  radiometry::Spectrum n, k;
};
/// A refractive index by `index`, its name in the built-in table, or by `n` and `k`; InputError unless it is one of these.
IndexSpectra refractive_index(const BsdfInputs& inputs);

}  // namespace ifov::materials
