#include "materials/bsdf/rough_conductor.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "materials/bsdf/facet_parameters.h"
#include "materials/bsdf/microfacet/facet_mueller.h"
#include "materials/bsdf/microfacet/facet_reflection.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"

namespace ifov::materials {

using math::Vec3;
using radiometry::Spectrum;

const BsdfModel RoughConductor::kModel{
    "rough_conductor",
    "metal, water, ice, minerals: facets of a complex refractive index (Cook and Torrance 1982; Heitz 2014), which absorb what "
    "they do not reflect; the reflectance is a factor on all of it, 1 where the surface is clean",
    with_index({{"roughness", "width of the distribution of the facets' slopes", BsdfParameter::Form::number,
                 0.0, 1.0},
                across_parameter(),
                direction_parameter(),
                {"distribution", "of the facets' slopes: `ggx`, with long tails, or `beckmann`, Gaussian",
                 BsdfParameter::Form::word, 0.0, 0.0, "\"ggx\"", false, facet_shapes}}),
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      const IndexSpectra index = refractive_index(inputs);
      const FacetWidths widths = facet_widths(inputs);
      return std::make_shared<RoughConductor>(
          index.n, index.k, inputs.reflectance,
          Facets{facet_shape(inputs), widths.along, widths.across, inputs.number("direction")});
    },
    true};

RoughConductor::RoughConductor(const Spectrum& n, const Spectrum& k, const Spectrum& factor, Facets facets)
    : TwoLobes(facets.direction_rad),
      facets_(facets.shape, facets.width_x, facets.width_y),
      albedo_(FacetAlbedo::shared(facets.shape, facets.width_x, facets.width_y)) {
  const std::vector<Spectrum> rows = FresnelRows::of_index(n, k);
  std::vector<Spectrum> all = rows;
  all.push_back(factor);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const Spectrum both[] = {rows[row], factor};
    spectra_.push_back(combined(both, [](std::span<const double> v) { return v[0] * v[1]; }));
  }
  for (const Spectrum& row : FresnelRows::polarization_of_index(n, k)) {
    const Spectrum both[] = {row, factor};
    polarization_.push_back(combined(both, [](std::span<const double> v) { return v[0] * v[1]; }));
  }
  spectra_.push_back(combined(all, [&](std::span<const double> v) {
    double mean = 0.0;
    for (std::size_t row = 0; row < FresnelRows::kCount; ++row)
      mean += FresnelRows::mean_weights()[row] * v[row];
    return v.back() * albedo_->again_factor(mean);
  }));
}

/// The broad lobe is of light that is reflected again: as often as perfect facets would send it, and never not at all.
double RoughConductor::broad_share(Vec3 out) const { return std::clamp(albedo_->lost(out), 1e-6, 0.999); }

Vec3 RoughConductor::draw(Lobe lobe, Vec3 out, sampling::Point2 u) const {
  if (lobe == Lobe::broad) return albedo_->sample(u);
  const Vec3 facet = facets_.sample_visible(out, u);
  return 2.0 * math::dot(out, facet) * facet - out;
}

double RoughConductor::density(Lobe lobe, const Directions& event) const {
  return lobe == Lobe::broad ? albedo_->pdf(event.in) : FacetReflection(facets_, event.out, event.in).density;
}

sampling::Point2 RoughConductor::undraw(Lobe lobe, const Directions& event) const {
  if (lobe == Lobe::broad) return albedo_->invert(event.in);
  return facets_.invert_visible(event.out, math::normalized(event.out + event.in));
}

double RoughConductor::grey_bsdf(const Directions& event) const {
  return FacetReflection(facets_, event.out, event.in).bsdf +
         albedo_->again(albedo_->lost(event.out), albedo_->lost(event.in));
}

Bsdf::LobeSlopes RoughConductor::lobe_slopes() const {
  return {std::min(facets_.width_x(), facets_.width_y()), std::max(facets_.width_x(), facets_.width_y())};
}

double RoughConductor::narrow_grey(const Directions& event) const {
  return FacetReflection(facets_, event.out, event.in).bsdf;
}

double RoughConductor::widened_grey(const Directions& event, double slope) const {
  return FacetReflection(facets_.widened(slope), event.out, event.in).bsdf;
}

void RoughConductor::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                              float* bsdf) const {
  const auto [out, in] = directions_of(event);
  const FacetReflection once(facets_, out, in);
  const RowWeights rows = FresnelRows::at(once.cosine);
  std::array<float, 4> w;
  for (std::size_t i = 0; i < 4; ++i) w[i] = static_cast<float>(once.bsdf * rows.weight[i]);
  const float again = static_cast<float>(albedo_->again(albedo_->lost(out), albedo_->lost(in)));
  const float* __restrict a = parameters[rows.first];
  const float* __restrict b = parameters[rows.first + 1];
  const float* __restrict c = parameters[rows.first + 2];
  const float* __restrict d = parameters[rows.first + 3];
  const float* __restrict e = parameters[FresnelRows::kCount];
  for (std::size_t n = 0; n < count; ++n)
    bsdf[n] = w[0] * a[n] + w[1] * b[n] + w[2] * c[n] + w[3] * d[n] + again * e[n];
}

void RoughConductor::evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                                      const MuellerRows& rows) const {
  const auto [out, in] = directions_of(event);
  const FacetReflection once(facets_, out, in);
  const float again = static_cast<float>(albedo_->again(albedo_->lost(out), albedo_->lost(in)));
  write_facets(FacetPlane(event), once, parameters.first(FresnelRows::kCount),
               parameters.subspan(FresnelRows::kCount + 1), count, rows);
  float* __restrict whole = rows.at(0, 0);
  const float* __restrict e = parameters[FresnelRows::kCount];
  for (std::size_t n = 0; n < count; ++n) whole[n] += again * e[n];
}

}  // namespace ifov::materials
