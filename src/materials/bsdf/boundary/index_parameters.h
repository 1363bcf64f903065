#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/facet_parameters.h"

namespace ifov::materials {

/// with_index() of what light goes through, 'n' and 'k' alone: names stand for rows that are thinned for what they reflect, within
/// 0.001 of |n + ik|, which says nothing of small k.
inline std::vector<BsdfParameter> with_numbers(std::vector<BsdfParameter> others) {
  std::vector<BsdfParameter> all = with_index(std::move(others));
  all.erase(all.begin());
  for (BsdfParameter& parameter : std::span(all).first(2)) parameter.optional = false;
  all[0].doc = "real part of the refractive index";
  return all;
}

/// Throws InputError where light goes through what is given by a name under `key`; `n`, `k`: what to give in its place.
void refuse_name(const BsdfInputs& inputs, std::string_view key, std::string_view n, std::string_view k);

/// Multiplies the rows that tell what is reflected.
void apply_factor(const radiometry::Spectrum& factor, std::size_t rows,
                  std::vector<radiometry::Spectrum>& shares);

}  // namespace ifov::materials
