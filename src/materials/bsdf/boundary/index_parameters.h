#pragma once

#include <span>
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

/// The same of what light goes through, 'n' and 'k' alone: names stand for rows that are thinned for what they reflect, within
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
