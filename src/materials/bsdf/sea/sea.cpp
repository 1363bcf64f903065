#include "materials/bsdf/sea/sea.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "materials/bsdf/microfacet/coat_rows.h"
#include "materials/bsdf/microfacet/facet_mueller.h"
#include "radiometry/refractive_index.h"
#include "sampling/warp.h"

namespace ifov::materials {

using math::Vec3;
using radiometry::Spectrum;
using std::numbers::inv_pi;
using std::numbers::pi;

namespace {

std::span<const std::string_view> statistics_words() {
  static constexpr std::array<std::string_view, 3> kWords{"anisotropic", "isotropic", "skewed"};
  return kWords;
}

SlopeStatistics statistics_of(const std::string& word) {
  return word == "isotropic" ? SlopeStatistics::isotropic
         : word == "skewed"  ? SlopeStatistics::skewed
                             : SlopeStatistics::anisotropic;
}

Sea::Surface surface_of(const BsdfInputs& inputs) {
  // Below, highlights on other surfaces are not sought (facet_width); the slopes were measured up to
  // kStrongest.
  constexpr double kWeakest = 1.6, kStrongest = 14.0;
  const double wind = inputs.number("wind");
  if (wind < kWeakest)
    throw InputError(format(
        "a wind of {:g} m/s is below {:g} m/s: the slopes that it leaves throw light on other surfaces that is not sought; calm water "
        "is {{\"smooth\": {{\"index\": \"water\", \"over\": \"absorber\"}}}}",
        wind, kWeakest));
  if (wind > kStrongest && inputs.say)
    inputs.say(format(
        "a wind of {:g} m/s is above the {:g} m/s up to which Cox and Munk (1954) measured the slopes of the sea",
        wind, kStrongest));
  Sea::Surface surface{wind, statistics_of(inputs.word("slopes")), inputs.number("wind_from"),
                       inputs.number("salinity"), std::nullopt};
  if (inputs.has("whitecaps")) surface.whitecaps = inputs.number("whitecaps");
  return surface;
}

}  // namespace

const BsdfModel Sea::kModel{
    "sea",
    "the sea under a wind: facets of sea water with the slopes of Cox and Munk 1954, whitecaps, and the water-leaving "
    "reflectance, which is the material's",
    {{"wind", "its speed, m/s, 12.5 m above the sea; measured from 1 to 14", BsdfParameter::Form::number, 0.0,
      30.0},
     {"wind_from", "azimuth from which it blows, clockwise from north", BsdfParameter::Form::angle, -360.0,
      360.0, "\"0 deg\""},
     {"slopes",
      "`anisotropic`: more along the wind than across it; `isotropic`; `skewed`: with the Gram-Charlier "
      "series",
      BsdfParameter::Form::word, 0.0, 0.0, "\"anisotropic\"", false, statistics_words},
     {"salinity", "g/kg: it adds to the index of water", BsdfParameter::Form::number, 0.0, 45.0, "35"},
     {"whitecaps",
      "the share that they cover, in place of 2.95e-6 wind^3.52 (Monahan and O'Muircheartaigh 1980)",
      BsdfParameter::Form::number,
      0.0,
      1.0,
      {},
      true},
     {"foam",
      "their reflectance, in place of that of Koepke 1984, 0.22 in visible light",
      BsdfParameter::Form::spectrum,
      0.0,
      1.0,
      {},
      true}},
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      return std::make_shared<Sea>(surface_of(inputs), inputs.reflectance,
                                   inputs.has("foam") ? inputs.spectrum("foam") : whitecap_reflectance());
    }};

Sea::Sea(const Surface& surface, const Spectrum& below, const Spectrum& foam)
    : TwoLobes(0.5 * pi - surface.wind_from_rad),
      slopes_(surface.wind_m_s, surface.slopes),
      even_width_(std::sqrt(slopes_.variance_along() + slopes_.variance_across())),
      albedo_(FacetAlbedo::shared(FacetShape::beckmann, even_width_, even_width_)) {
  const double white = surface.whitecaps.value_or(whitecap_share(surface.wind_m_s)), clear = 1.0 - white;

  const Spectrum n = sea_water_index(surface.salinity);
  const Spectrum& k = radiometry::refractive_index("water").k;
  const std::vector<Spectrum> fresnel = FresnelRows::of_index(n, k);
  for (const Spectrum& row : fresnel) spectra_.push_back(row.scaled(clear));
  spectra_.push_back(combined(fresnel, [&](std::span<const double> v) {
    return clear * albedo_->again_factor(mean_reflectance(v));
  }));
  const std::vector<Spectrum> passed = CoatRows::of_fresnel(FacetShape::beckmann, even_width_, fresnel);
  spectra_.insert(spectra_.end(), passed.begin(), passed.begin() + CoatRows::kCount);
  const Spectrum both[] = {below, passed[CoatRows::kCount - 1]};
  spectra_.push_back(combined(both, [&](std::span<const double> v) { return clear * v[0] / (v[1] * v[1]); }));
  spectra_.push_back(foam.scaled(white));
  grey_ = grey_levels(spectra_);

  polarization_ = FresnelRows::polarization_of_index(n, k);
  const std::vector<Spectrum> along = CoatRows::polarization_of_fresnel(
      FacetShape::beckmann, even_width_, std::span(polarization_).first(FresnelRows::kCount));
  for (Spectrum& row : polarization_) row = row.scaled(clear);
  polarization_.insert(polarization_.end(), along.begin(), along.end());
}

double Sea::broad_share(Vec3 out) const {
  const double broad = grey_[kBelow] + grey_[kFoam], narrow = CoatRows::mixed(FresnelRows::at(out.z), grey_);
  return std::clamp(broad / (broad + narrow), 0.05, 0.8);
}

Vec3 Sea::draw(Lobe lobe, Vec3 out, sampling::Point2 u) const {
  if (lobe == Lobe::broad) return sampling::cosine_hemisphere(u);
  const Vec3 facet = slopes_.gaussian().sample_visible(out, u);
  return 2.0 * math::dot(out, facet) * facet - out;
}

double Sea::density(Lobe lobe, const Directions& event) const {
  return lobe == Lobe::broad ? sampling::cosine_hemisphere_density(event.in)
                             : SeaReflection(slopes_, event.out, event.in).density;
}

sampling::Point2 Sea::undraw(Lobe lobe, const Directions& event) const {
  if (lobe == Lobe::broad) return sampling::cosine_hemisphere_inverse(event.in);
  return slopes_.gaussian().invert_visible(event.out, math::normalized(event.out + event.in));
}

Bsdf::LobeSlopes Sea::lobe_slopes() const {
  const double x = slopes_.gaussian().width_x(), y = slopes_.gaussian().width_y();
  return {std::min(x, y), std::max(x, y)};
}

double Sea::narrow_grey(const Directions& event) const {
  const SeaReflection once(slopes_, event.out, event.in);
  return once.bsdf * CoatRows::mixed(FresnelRows::at(once.cosine), grey_);
}

double Sea::grey_bsdf(const Directions& event) const {
  const std::span<const double> passed(grey_.data() + kPassed, CoatRows::kCount);
  return narrow_grey(event) +
         albedo_->again(albedo_->lost(event.out), albedo_->lost(event.in)) * grey_[kAgain] +
         inv_pi * (grey_[kFoam] + grey_[kBelow] * CoatRows::mixed(CoatRows::at(event.out.z), passed) *
                                      CoatRows::mixed(CoatRows::at(event.in.z), passed));
}

void Sea::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                   float* bsdf) const {
  const auto [out, in] = directions_of(event);
  const SeaReflection once(slopes_, out, in);
  const RowWeights fresnel = FresnelRows::at(once.cosine), there = CoatRows::at(out.z),
                   back = CoatRows::at(in.z);
  std::array<float, 4> f{}, a{}, b{};
  for (std::size_t i = 0; i < 4; ++i) {
    f[i] = static_cast<float>(once.bsdf * fresnel.weight[i]);
    a[i] = static_cast<float>(there.weight[i]);
    b[i] = static_cast<float>(back.weight[i]);
  }
  const float again = static_cast<float>(albedo_->again(albedo_->lost(out), albedo_->lost(in)));
  const float even = static_cast<float>(inv_pi);
  const float* const* r = &parameters[fresnel.first];
  const float* const* p = &parameters[kPassed + there.first];
  const float* const* q = &parameters[kPassed + back.first];
  const float* __restrict more = parameters[kAgain];
  const float* __restrict below = parameters[kBelow];
  const float* __restrict foam = parameters[kFoam];
  for (std::size_t n = 0; n < count; ++n) {
    const float facets = f[0] * r[0][n] + f[1] * r[1][n] + f[2] * r[2][n] + f[3] * r[3][n] + again * more[n];
    const float passes_out = a[0] * p[0][n] + a[1] * p[1][n] + a[2] * p[2][n] + a[3] * p[3][n];
    const float passes_in = b[0] * q[0][n] + b[1] * q[1][n] + b[2] * q[2][n] + b[3] * q[3][n];
    bsdf[n] = facets + even * (foam[n] + passes_out * passes_in * below[n]);
  }
}

void Sea::evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                           const MuellerRows& rows) const {
  const auto [out, in] = directions_of(event);
  const std::size_t own = spectra_.size();
  write_facets(FacetPlane(event), SeaReflection(slopes_, out, in), parameters.first(FresnelRows::kCount),
               parameters.subspan(own), count, rows);
  CoatRows::add_under(out.z, in.z, parameters.subspan(kPassed),
                      parameters.subspan(own + 3 * FresnelRows::kCount), parameters[kBelow], count, rows);
  const float again = static_cast<float>(albedo_->again(albedo_->lost(out), albedo_->lost(in)));
  const float even = static_cast<float>(inv_pi);
  for (std::size_t n = 0; n < count; ++n)
    rows.at(0, 0)[n] += again * parameters[kAgain][n] + even * parameters[kFoam][n];
}

}  // namespace ifov::materials
