#include "materials/bsdf/leaf/waxed_leaf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "materials/bsdf/leaf/wax_coat.h"
#include "materials/bsdf/microfacet/facet_mueller.h"
#include "sampling/warp.h"

namespace ifov::materials {

using math::Vec3;
using radiometry::Spectrum;
using std::numbers::inv_pi;

WaxCoat::WaxCoat(const Spectrum& index, double width, const Spectrum& inner_reflectance,
                 const Spectrum& inner_transmittance)
    : facets_(FacetShape::ggx, width, width), albedo_(FacetAlbedo::shared(FacetShape::ggx, width, width)) {
  spectra_ = FresnelRows::of_index(index, Spectrum::constant(0.0));
  const std::vector<Spectrum> fresnel = spectra_;
  spectra_.push_back(combined(
      fresnel, [&](std::span<const double> v) { return albedo_->again_factor(mean_reflectance(v)); }));
  const std::vector<Spectrum> passed = CoatRows::of_fresnel(FacetShape::ggx, width, fresnel);
  spectra_.insert(spectra_.end(), passed.begin(), passed.begin() + CoatRows::kCount);
  for (const Spectrum* inner : {&inner_reflectance, &inner_transmittance}) {
    const Spectrum both[] = {*inner, passed.back()};
    spectra_.push_back(combined(both, [](std::span<const double> v) { return v[0] / v[1]; }));
  }
  grey_ = grey_levels(spectra_);
  polarization_ = FresnelRows::polarization_of_index(index, Spectrum::constant(0.0));
  const std::vector<Spectrum> along = CoatRows::polarization_of_fresnel(
      FacetShape::ggx, width, std::span(polarization_).first(FresnelRows::kCount));
  polarization_.insert(polarization_.end(), along.begin(), along.end());
}

double WaxCoat::grey_spread(double cosine_out, double cosine_in, std::size_t place) const {
  const std::span<const double> passed(grey_.data() + kPassed, CoatRows::kCount);
  return inv_pi * grey_[place] * CoatRows::mixed(CoatRows::at(cosine_out), passed) *
         CoatRows::mixed(CoatRows::at(cosine_in), passed);
}

// As often as perfect facets would be drawn at a fifth: where they are grazed they are bright.
double WaxCoat::broad_share(Vec3 out) const {
  const double narrow = CoatRows::mixed(FresnelRows::at(out.z), grey_);
  return std::clamp(grey_[kBack] / (grey_[kBack] + narrow), 0.1, 0.8);
}

Vec3 WaxCoat::draw(Lobe lobe, Vec3 out, sampling::Point2 u) const {
  if (lobe == Lobe::broad) return sampling::cosine_hemisphere(u);
  const Vec3 facet = facets_.sample_visible(out, u);
  return 2.0 * math::dot(out, facet) * facet - out;
}

double WaxCoat::density(Lobe lobe, const Directions& event) const {
  return lobe == Lobe::broad ? sampling::cosine_hemisphere_density(event.in)
                             : FacetReflection(facets_, event.out, event.in).density;
}

sampling::Point2 WaxCoat::undraw(Lobe lobe, const Directions& event) const {
  if (lobe == Lobe::broad) return sampling::cosine_hemisphere_inverse(event.in);
  return facets_.invert_visible(event.out, math::normalized(event.out + event.in));
}

double WaxCoat::narrow_grey(const Directions& event) const {
  const FacetReflection once(facets_, event.out, event.in);
  return once.bsdf * CoatRows::mixed(FresnelRows::at(once.cosine), grey_);
}

double WaxCoat::grey_bsdf(const Directions& event) const {
  return narrow_grey(event) +
         albedo_->again(albedo_->lost(event.out), albedo_->lost(event.in)) * grey_[kAgain] +
         grey_spread(event.out.z, event.in.z, kBack);
}

void WaxCoat::spread(double cosine_out, double cosine_in, ParameterSpectra parameters, std::size_t place,
                     std::size_t count, float* bsdf) {
  const RowWeights there = CoatRows::at(cosine_out), back = CoatRows::at(cosine_in);
  std::array<float, 4> a{}, b{};
  for (std::size_t i = 0; i < 4; ++i) {
    a[i] = static_cast<float>(there.weight[i]);
    b[i] = static_cast<float>(back.weight[i]);
  }
  const float* const* p = &parameters[kPassed + there.first];
  const float* const* q = &parameters[kPassed + back.first];
  const float* __restrict inner = parameters[place];
  for (std::size_t n = 0; n < count; ++n) {
    const float out = a[0] * p[0][n] + a[1] * p[1][n] + a[2] * p[2][n] + a[3] * p[3][n];
    const float in = b[0] * q[0][n] + b[1] * q[1][n] + b[2] * q[2][n] + b[3] * q[3][n];
    bsdf[n] = out * in *
              (inner[n] * static_cast<float>(inv_pi));  // the same with directions exchanged, to the last bit
  }
}

void WaxCoat::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                       float* bsdf) const {
  const auto [out, in] = directions_of(event);
  spread(out.z, in.z, parameters, kBack, count, bsdf);
  const FacetReflection once(facets_, out, in);
  const RowWeights fresnel = FresnelRows::at(once.cosine);
  std::array<float, 4> f{};
  for (std::size_t i = 0; i < 4; ++i) f[i] = static_cast<float>(once.bsdf * fresnel.weight[i]);
  const float again = static_cast<float>(albedo_->again(albedo_->lost(out), albedo_->lost(in)));
  const float* const* r = &parameters[fresnel.first];
  const float* __restrict more = parameters[kAgain];
  for (std::size_t n = 0; n < count; ++n)
    bsdf[n] += f[0] * r[0][n] + f[1] * r[1][n] + f[2] * r[2][n] + f[3] * r[3][n] + again * more[n];
}

void WaxCoat::spread_mueller(double cosine_out, double cosine_in, ParameterSpectra parameters,
                             std::size_t place, std::size_t count, const MuellerRows& rows) const {
  CoatRows::add_under(cosine_out, cosine_in, parameters.subspan(kPassed),
                      parameters.subspan(spectra_.size() + 3 * FresnelRows::kCount), parameters[place], count,
                      rows);
}

void WaxCoat::evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                               const MuellerRows& rows) const {
  const auto [out, in] = directions_of(event);
  write_facets(FacetPlane(event), FacetReflection(facets_, out, in), parameters.first(FresnelRows::kCount),
               parameters.subspan(spectra_.size()), count, rows);
  spread_mueller(out.z, in.z, parameters, kBack, count, rows);
  const float again = static_cast<float>(albedo_->again(albedo_->lost(out), albedo_->lost(in)));
  for (std::size_t n = 0; n < count; ++n) rows.at(0, 0)[n] += again * parameters[kAgain][n];
}

WaxedLeaf::WaxedLeaf(const Spectrum& index, double width, const Spectrum& inner_reflectance,
                     const Spectrum& inner_transmittance)
    : coat_(std::make_unique<WaxCoat>(index, width, inner_reflectance, inner_transmittance)) {}

WaxedLeaf::~WaxedLeaf() = default;

// Light that has passed the leaf is drawn as Lambert's law has it.
BsdfSample WaxedLeaf::sample(const BsdfEvent& view, double u1, double u2) const {
  return view.side == Side::reflected ? coat_->sample(view, u1, u2) : Bsdf::sample(view, u1, u2);
}

double WaxedLeaf::pdf(const BsdfEvent& event) const {
  return event.side == Side::reflected ? coat_->pdf(event) : Bsdf::pdf(event);
}

UnitSquarePoint WaxedLeaf::invert(const BsdfEvent& event) const {
  return event.side == Side::reflected ? coat_->invert(event) : Bsdf::invert(event);
}

double WaxedLeaf::seam(const BsdfEvent& view) const {
  return view.side == Side::reflected ? coat_->seam(view) : 0.0;
}

double WaxedLeaf::grey(const BsdfEvent& event) const {
  if (event.side == Side::reflected) return coat_->grey(event);
  const double out = event.outgoing_cosine(), in = event.incoming_cosine();
  return out > 0.0 && in > 0.0 ? coat_->grey_spread(out, in, WaxCoat::kThrough) : 0.0;
}

Bsdf::LobeSlopes WaxedLeaf::lobe_slopes() const { return coat_->lobe_slopes(); }

double WaxedLeaf::lobe_share(const BsdfEvent& event) const {
  return event.side == Side::reflected ? coat_->lobe_share(event) : 0.0;
}

std::span<const Spectrum> WaxedLeaf::spectra() const { return coat_->spectra(); }

void WaxedLeaf::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                         float* bsdf) const {
  if (event.side == Side::reflected)
    coat_->evaluate(event, parameters, count, bsdf);
  else
    WaxCoat::spread(event.outgoing_cosine(), event.incoming_cosine(), parameters, WaxCoat::kThrough, count,
                    bsdf);
}

std::span<const Spectrum> WaxedLeaf::polarization_spectra() const { return coat_->polarization_spectra(); }

void WaxedLeaf::evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                                 const MuellerRows& rows) const {
  if (event.side == Side::reflected) return coat_->evaluate_mueller(event, parameters, count, rows);
  for (std::size_t column = 0; column < rows.columns(); ++column)
    for (std::size_t row = 0; row < 4; ++row) std::fill_n(rows.at(row, column), count, 0.0f);
  coat_->spread_mueller(event.outgoing_cosine(), event.incoming_cosine(), parameters, WaxCoat::kThrough,
                        count, rows);
}

}  // namespace ifov::materials
