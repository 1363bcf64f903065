#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/error.h"
#include "materials/bsdf/facet_parameters.h"
#include "materials/bsdf/narrow_lobes.h"
#include "materials/bsdf/polarized/facet_brdf.h"

namespace ifov::materials {

using radiometry::Spectrum;

namespace {

using Form = BsdfParameter::Form;

std::span<const std::string_view> masking_words() {
  static constexpr std::array<std::string_view, 2> kWords{"torrance_sparrow", "smith"};
  return kWords;
}

/// Keys of the facets' refractive index, and of their slope.
std::vector<BsdfParameter> with_facets(std::vector<BsdfParameter> more, std::string_view slope_doc) {
  std::vector<BsdfParameter> all{{"slope", slope_doc, Form::number, 0.0, 1.0}};
  all.insert(all.end(), more.begin(), more.end());
  return with_index(std::move(all));
}

const BsdfParameter kTau{"tau",
                         "of the obscuration: how soon it sets in with the angle of incidence on facets",
                         Form::angle, 0.1, 720.0};
const BsdfParameter kOmega{"omega", "of the obscuration: how soon it sets in with the tilt of facets",
                           Form::angle, 0.1, 720.0};
const BsdfParameter kVolumePart{
    "volume", "what volume scattering reflects: pi rho_V", Form::spectrum, 0.0, 1.0, "0"};

/// A slope whose lobe is so wide that paths find what it throws.
double slope_of(const BsdfInputs& inputs, double width_by_slope) {
  const double slope = inputs.number("slope"), least = kLeastFoundSlope / width_by_slope;
  if (slope < least)
    throw InputError(format(
        "a 'slope' of {:g} is below {:.3g}: what so narrow a lobe throws on other surfaces is not sought; a smooth surface is 'smooth', by "
        "its refractive index, or 'mirror'",
        slope, least));
  return slope;
}

FacetBrdf::Obscuration obscuration_of(const BsdfInputs& inputs) {
  return {inputs.number("tau"), inputs.number("omega")};
}

std::shared_ptr<const Bsdf> made(const BsdfInputs& inputs, const FacetBrdf::Surface& surface,
                                 const Spectrum& volume) {
  const IndexSpectra index = refractive_index(inputs);
  return std::make_shared<FacetBrdf>(surface, index.n, index.k, inputs.reflectance, volume);
}

}  // namespace

const BsdfModel FacetBrdf::kPriestGermer{
    "priest_germer",
    "painted and metal targets, polarized: Gaussian facets and a diffuse part, which is the reflectance (Priest and Germer 2000; "
    "Priest and Meier 2002; Hyde et al. 2009)",
    with_facets({{"shadowing", "of facets by others: `torrance_sparrow` (V-grooves) or `smith`", Form::word,
                  0.0, 0.0, "\"torrance_sparrow\"", false, masking_words}},
                "sigma: standard deviation of the facets' slope along any direction"),
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      Surface surface{Slopes::gaussian, slope_of(inputs, std::numbers::sqrt2),
                      inputs.word("shadowing") == "smith" ? Masking::smith : Masking::torrance_sparrow,
                      std::nullopt, 1.0};
      return made(inputs, surface, Spectrum::constant(0.0));
    }};

const BsdfModel FacetBrdf::kMaxwellBeard{
    "maxwell_beard",
    "painted and natural targets by the parameters of the NEF database (Maxwell, Beard et al. 1973; Westlund and Meyer 2002); the "
    "reflectance is pi rho_D",
    with_facets(
        {{"bias",
          "B of the distribution of the facets' slopes; without it, that of facets that cover the surface",
          Form::number,
          0.0,
          10.0,
          {},
          true},
         kTau,
         kOmega,
         kVolumePart},
        "sigma of the distribution of the facets' slopes, B / (cos^3 (sigma^2 + tan^2))"),
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      const double slope = slope_of(inputs, 1.0), covering = covering_bias(slope);
      const double bias = inputs.has("bias") ? inputs.number("bias") : covering;
      if (bias > covering && inputs.say)
        inputs.say(
            format("a 'bias' of {:g} is above {:.3g}, with which facets of slope {:g} cover the surface",
                   bias, covering, slope));
      const IndexSpectra index = refractive_index(inputs);
      auto model = std::make_shared<FacetBrdf>(
          Surface{Slopes::maxwell_beard, slope, Masking::smith, obscuration_of(inputs), bias}, index.n,
          index.k, inputs.reflectance, inputs.spectrum("volume"));
      const double last_deg = std::acos(model->least_cosine()) * 180.0 / std::numbers::pi;
      if (last_deg < 80.0 && inputs.say)
        inputs.say(format(
            "more than {:.0f} deg from the normal maxwell_beard is held as it is there, for it grows without bound and "
            "would send back more than arrives",
            last_deg));
      return model;
    }};

const BsdfModel FacetBrdf::kShellTarget{
    "shell_target",
    "polarized targets as DIRSIG has them (Shell 2005): facets of Priest and Germer with the obscuration of Maxwell and Beard; the "
    "reflectance is pi rho_D",
    with_facets({kTau, kOmega, kVolumePart},
                "sigma: standard deviation of the facets' slope along any direction"),
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      return made(inputs,
                  {Slopes::gaussian, slope_of(inputs, std::numbers::sqrt2), Masking::smith,
                   obscuration_of(inputs), 1.0},
                  inputs.spectrum("volume"));
    }};

}  // namespace ifov::materials
