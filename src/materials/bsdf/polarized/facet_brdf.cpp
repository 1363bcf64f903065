#include "materials/bsdf/polarized/facet_brdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "materials/bsdf/microfacet/coat_rows.h"
#include "materials/bsdf/microfacet/facet_mueller.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"
#include "materials/bsdf/microfacet/visible_facets.h"
#include "sampling/warp.h"

namespace ifov::materials {

using math::Vec3;
using radiometry::Spectrum;
using std::numbers::inv_pi;
using std::numbers::pi;

namespace {

constexpr std::size_t kDiffuse = FresnelRows::kCount, kVolume = kDiffuse + 1;

FacetDistribution distribution_of(const FacetBrdf::Surface& surface) {
  const bool gaussian = surface.slopes == FacetBrdf::Slopes::gaussian;
  const double width = gaussian ? std::numbers::sqrt2 * surface.slope : surface.slope;
  return {gaussian ? FacetShape::beckmann : FacetShape::ggx, width, width};
}

}  // namespace

double FacetBrdf::Obscuration::share(double tilt_rad, double incidence_rad) const {
  const double steep = tilt_rad / omega_rad;
  return (1.0 + steep * std::exp(-2.0 * incidence_rad / tau_rad)) / (1.0 + steep);
}

double FacetBrdf::covering_bias(double slope) {
  const double q2 = 1.0 - slope * slope;
  double integral = 0.0;
  if (std::abs(q2) < 1e-6)
    integral = 1.0;
  else if (q2 > 0.0)
    integral = std::log((1.0 + std::sqrt(q2)) / slope) / std::sqrt(q2);
  else
    integral = std::atan(std::sqrt(-q2)) / std::sqrt(-q2);
  return 1.0 / (2.0 * pi * integral);
}

FacetBrdf::FacetBrdf(const Surface& surface, const Spectrum& n, const Spectrum& k, const Spectrum& diffuse,
                     const Spectrum& volume)
    : surface_(surface), drawn_(distribution_of(surface)), spectra_(FresnelRows::of_index(n, k)) {
  spectra_.push_back(diffuse);
  spectra_.push_back(volume);
  polarization_ = FresnelRows::polarization_of_index(n, k);
  grey_ = grey_levels(spectra_);
  // Held at ever larger cosines, as long as more would come back than arrives.
  constexpr double kStep = 1.25, kMost = 0.5;
  if (surface.slopes == Slopes::maxwell_beard)
    while (highest_reflectance() > 0.998 && least_cosine_ < kMost) least_cosine_ *= kStep;
}

double FacetBrdf::highest_reflectance() const {
  constexpr double kCosines[] = {1.0, 0.7, 0.5, 0.4, 0.3, 0.2, 0.15, 0.1, 0.07, 0.05, 0.02};
  std::vector<double> fresnel;
  for (std::size_t k = 0; k < FresnelRows::kCount; ++k) fresnel.push_back(spectra_[k].maximum());
  const double diffuse = spectra_[kDiffuse].maximum(), volume = spectra_[kVolume].maximum();
  const VisibleFacets grid(48);
  double highest = 0.0;
  for (const double cosine : kCosines) {
    const Vec3 out{std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
    // 2 cos / (cos + cos out), over projected solid angle.
    double whole = diffuse + 4.0 * volume * (1.0 - cosine * std::log1p(1.0 / cosine));
    grid.for_each_reflection(drawn_, out, [&](double weight, double at, Vec3 in) {
      const double drawn = FacetReflection(drawn_, out, in).bsdf;
      if (drawn > 0.0)
        whole += weight * reflection({out, in}).bsdf / drawn * CoatRows::mixed(FresnelRows::at(at), fresnel);
    });
    highest = std::max(highest, whole);
  }
  return highest;
}

FacetReflection FacetBrdf::reflection(const Directions& event) const {
  const auto& [out, in] = event;
  FacetReflection once(drawn_, out, in);
  const Vec3 facet = math::normalized(out + in);
  if (surface_.masking == Masking::torrance_sparrow) {
    const double groove = 2.0 * facet.z / std::max(once.cosine, 1e-12);
    once.bsdf =
        0.25 * drawn_.density(facet) * std::min({1.0 / (out.z * in.z), groove / in.z, groove / out.z});
  }
  if (surface_.slopes == Slopes::maxwell_beard) {
    const double z2 = facet.z * facet.z, s2 = surface_.slope * surface_.slope;
    once.bsdf = 0.25 / (facet.z * (s2 * z2 + 1.0 - z2)) /
                (std::max(out.z, least_cosine_) * std::max(in.z, least_cosine_));
  }
  if (surface_.obscuration)
    once.bsdf *= surface_.obscuration->share(std::acos(std::min(1.0, facet.z)), std::acos(once.cosine));
  once.bsdf *= surface_.scale;
  return once;
}

Bsdf::LobeSlopes FacetBrdf::lobe_slopes() const { return {drawn_.width_x(), drawn_.width_x()}; }

double FacetBrdf::broad_share(Vec3 out) const {
  const double broad = grey_[kDiffuse] + grey_[kVolume],
               narrow = CoatRows::mixed(FresnelRows::at(out.z), grey_);
  return std::clamp(broad / (broad + narrow), 0.1, 0.8);
}

Vec3 FacetBrdf::draw(Lobe lobe, Vec3 out, sampling::Point2 u) const {
  if (lobe == Lobe::broad) return sampling::cosine_hemisphere(u);
  const Vec3 facet = drawn_.sample_visible(out, u);
  return 2.0 * math::dot(out, facet) * facet - out;
}

double FacetBrdf::density(Lobe lobe, const Directions& event) const {
  return lobe == Lobe::broad ? sampling::cosine_hemisphere_density(event.in)
                             : FacetReflection(drawn_, event.out, event.in).density;
}

sampling::Point2 FacetBrdf::undraw(Lobe lobe, const Directions& event) const {
  if (lobe == Lobe::broad) return sampling::cosine_hemisphere_inverse(event.in);
  return drawn_.invert_visible(event.out, math::normalized(event.out + event.in));
}

double FacetBrdf::narrow_grey(const Directions& event) const {
  const FacetReflection once = reflection(event);
  return once.bsdf * CoatRows::mixed(FresnelRows::at(once.cosine), grey_);
}

double FacetBrdf::grey_bsdf(const Directions& event) const {
  return narrow_grey(event) + inv_pi * (grey_[kDiffuse] + 2.0 * grey_[kVolume] / (event.out.z + event.in.z));
}

void FacetBrdf::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                         float* bsdf) const {
  const Directions directions = directions_of(event);
  const FacetReflection once = reflection(directions);
  const RowWeights rows = FresnelRows::at(once.cosine);
  std::array<float, 4> w{};
  for (std::size_t i = 0; i < 4; ++i) w[i] = static_cast<float>(once.bsdf * rows.weight[i]);
  const float even = static_cast<float>(inv_pi),
              through = static_cast<float>(2.0 * inv_pi / (directions.out.z + directions.in.z));
  const float* const* r = &parameters[rows.first];
  const float* __restrict diffuse = parameters[kDiffuse];
  const float* __restrict volume = parameters[kVolume];
  for (std::size_t n = 0; n < count; ++n)
    bsdf[n] = w[0] * r[0][n] + w[1] * r[1][n] + w[2] * r[2][n] + w[3] * r[3][n] + even * diffuse[n] +
              through * volume[n];
}

void FacetBrdf::evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                                 const MuellerRows& rows) const {
  const Directions directions = directions_of(event);
  write_facets(FacetPlane(event), reflection(directions), parameters.first(FresnelRows::kCount),
               parameters.subspan(spectra_.size()), count, rows);
  const float even = static_cast<float>(inv_pi),
              through = static_cast<float>(2.0 * inv_pi / (directions.out.z + directions.in.z));
  for (std::size_t n = 0; n < count; ++n)
    rows.at(0, 0)[n] += even * parameters[kDiffuse][n] + through * parameters[kVolume][n];
}

}  // namespace ifov::materials
