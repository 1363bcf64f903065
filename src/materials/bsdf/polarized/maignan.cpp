#include "materials/bsdf/polarized/maignan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/error.h"
#include "materials/bsdf/microfacet/facet_mueller.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"

namespace ifov::materials {

using radiometry::Spectrum;
using std::numbers::inv_pi;

const BsdfModel Maignan::kModel{
    "maignan",
    "soil and vegetation from afar with the light that they polarize (Maignan et al. 2009); the reflectance is that of the rest, "
    "which is unpolarized",
    {{"coefficient", "C, by the kind of surface; 5 to 7 of most classes of the paper",
      BsdfParameter::Form::number, 0.0, 20.0},
     {"ndvi", "vegetation index of the surface", BsdfParameter::Form::number, -0.2, 1.0},
     {"index", "refractive index of leaves and grains", BsdfParameter::Form::spectrum, 1.0, 10.0, "1.5"}},
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      return std::make_shared<Maignan>(inputs.reflectance, inputs.number("coefficient"),
                                       inputs.number("ndvi"), inputs.spectrum("index"));
    }};

Maignan::Maignan(const Spectrum& reflectance, double coefficient, double ndvi, const Spectrum& n)
    : level_(coefficient * std::exp(-ndvi) * 0.25 * inv_pi),
      spectra_(FresnelRows::of_index(n, Spectrum::constant(0.0))),
      polarization_(FresnelRows::polarization_of_index(n, Spectrum::constant(0.0))) {
  spectra_.push_back(reflectance);
}

FacetReflection Maignan::reflection(const BsdfEvent& event) const {
  // The angle alone is that of facets.
  static const FacetDistribution any(FacetShape::ggx, 1.0, 1.0);
  FacetReflection once(any, {0.0, 0.0, 1.0}, {0.0, 0.0, 1.0});
  const double square = std::clamp(0.5 + 0.5 * math::dot(event.outgoing, event.incoming), 0.0, 1.0);
  once.cosine = std::sqrt(square);
  const double tangent = std::sqrt((1.0 - square) / std::max(square, 1e-12));
  once.bsdf = level_ * std::exp(-tangent) / (event.outgoing_cosine() + event.incoming_cosine());
  return once;
}

void Maignan::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                       float* bsdf) const {
  const FacetReflection once = reflection(event);
  const RowWeights rows = FresnelRows::at(once.cosine);
  std::array<float, 4> w{};
  for (std::size_t i = 0; i < 4; ++i) w[i] = static_cast<float>(once.bsdf * rows.weight[i]);
  const float* const* r = &parameters[rows.first];
  const float* __restrict reflectance = parameters[FresnelRows::kCount];
  const float even = static_cast<float>(inv_pi);
  for (std::size_t n = 0; n < count; ++n)
    bsdf[n] = w[0] * r[0][n] + w[1] * r[1][n] + w[2] * r[2][n] + w[3] * r[3][n] + even * reflectance[n];
}

void Maignan::evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                               const MuellerRows& rows) const {
  write_facets(FacetPlane(event), reflection(event), parameters.first(FresnelRows::kCount),
               parameters.subspan(spectra_.size()), count, rows);
  const float even = static_cast<float>(inv_pi);
  for (std::size_t n = 0; n < count; ++n) rows.at(0, 0)[n] += even * parameters[FresnelRows::kCount][n];
}

}  // namespace ifov::materials
