#pragma once

#include <string_view>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "radiometry/refractive_index.h"

namespace ifov::materials {

/// The keys of a complex index, 'index' or 'n' and 'k', before others of a model; refractive_index() reads them.
inline std::vector<BsdfParameter> with_index(std::vector<BsdfParameter> others) {
  constexpr double kLeast = 0.01, kMost = 1000.0;
  std::vector<BsdfParameter> all{
      {"index",
       "name of a refractive index of the built-in table",
       BsdfParameter::Form::word,
       0.0,
       0.0,
       {},
       true,
       radiometry::refractive_index_names},
      {"n",
       "real part of the refractive index, in place of a name",
       BsdfParameter::Form::spectrum,
       kLeast,
       kMost,
       {},
       true},
      {"k", "imaginary part: absorption", BsdfParameter::Form::spectrum, 0.0, kMost, {}, true}};
  for (BsdfParameter& other : others) all.push_back(std::move(other));
  return all;
}

/// Multiplies the rows that tell what is reflected.
void apply_factor(const radiometry::Spectrum& factor, std::size_t rows,
                  std::vector<radiometry::Spectrum>& shares);

}  // namespace ifov::materials
