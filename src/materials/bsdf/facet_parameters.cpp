#include "materials/bsdf/facet_parameters.h"

#include <array>
#include <utility>

#include "core/error.h"
#include "materials/bsdf/narrow_lobes.h"
#include "radiometry/refractive_index.h"

namespace ifov::materials {

std::span<const std::string_view> facet_shapes() {
  static constexpr std::array<std::string_view, 2> kWords{"ggx", "beckmann"};
  return kWords;
}

FacetShape facet_shape(const BsdfInputs& inputs) {
  return inputs.word("distribution") == "ggx" ? FacetShape::ggx : FacetShape::beckmann;
}

double facet_width(const BsdfInputs& inputs, std::string_view key, bool widens) {
  // What narrower lobes throw on other surfaces has to be marked, for which they are widened.
  constexpr double kLeast = 0.01;
  const double width = inputs.number(key), least = widens ? kLeast : kLeastFoundSlope;
  if (width < least)
    throw InputError(format(
        "a '{}' of {:g} is below {:g}: what so narrow a lobe throws on other surfaces is not sought; a smooth surface is 'smooth', by "
        "its refractive index, or 'mirror'",
        key, width, least));
  return width;
}

BsdfParameter across_parameter() {
  return {"across",
          "the width across the direction, where it is another",
          BsdfParameter::Form::number,
          0.0,
          1.0,
          {},
          true};
}

BsdfParameter direction_parameter() {
  return {"direction",
          "along which `roughness` is the width: from the tangent (east), counterclockwise",
          BsdfParameter::Form::angle,
          -360.0,
          360.0,
          "\"0 deg\""};
}

FacetWidths facet_widths(const BsdfInputs& inputs) {
  const double along = facet_width(inputs, "roughness");
  return {along, inputs.has("across") ? facet_width(inputs, "across") : along};
}

std::vector<BsdfParameter> with_index(std::vector<BsdfParameter> others) {
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

IndexSpectra refractive_index(const BsdfInputs& inputs) {
  const bool by_name = inputs.has("index"), by_value = inputs.has("n") || inputs.has("k");
  if (by_name && by_value)
    throw InputError(
        "a refractive index is given either by its name, 'index', or as 'n' and 'k', not by both");
  if (by_name) {
    const radiometry::RefractiveIndex& found = radiometry::refractive_index(inputs.word("index"));
    return {found.n, found.k};
  }
  if (!inputs.has("n") || !inputs.has("k"))
    throw InputError(format(
        "{} missing: a refractive index is given by its name, 'index', or as 'n' and 'k', such as \"index\": \"water\"",
        !by_value         ? "the refractive index is"
        : inputs.has("n") ? "'k' is"
                          : "'n' is"));
  return {inputs.spectrum("n"), inputs.spectrum("k")};
}

}  // namespace ifov::materials
