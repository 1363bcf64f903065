#include "materials/bsdf/rough_dielectric.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "materials/bsdf/facet_parameters.h"
#include "materials/bsdf/microfacet/facet_mueller.h"
#include "materials/bsdf/microfacet/facet_reflection.h"
#include "materials/bsdf/microfacet/visible_facets.h"
#include "sampling/warp.h"

namespace ifov::materials {

using math::Vec3;
using radiometry::Spectrum;
using std::numbers::inv_pi;

namespace {

std::span<const std::string_view> bases() {
  static constexpr std::array<std::string_view, 1> kWords{"lambertian"};
  return kWords;
}

double angle_cosine(std::size_t k, std::size_t count) {
  const double t = static_cast<double>(k) / static_cast<double>(count - 1);
  return t * t;
}

}  // namespace

const BsdfModel RoughDielectric::kModel{
    "rough_dielectric",
    "lacquer, gloss paint: a clear coat with a rough surface on a base, whose reflectance is the material's; what goes to and fro "
    "under the surface counts",
    {{"index", "refractive index of the coat", BsdfParameter::Form::spectrum, 1.0, 10.0, "1.5"},
     {"roughness", "width of the distribution of the surface's slopes", BsdfParameter::Form::number, 0.0,
      1.0},
     {"distribution", "of the slopes: `ggx`, with long tails, or `beckmann`, Gaussian",
      BsdfParameter::Form::word, 0.0, 0.0, "\"ggx\"", false, facet_shapes},
     {"over", "the base under the coat", BsdfParameter::Form::word, 0.0, 0.0, "\"lambertian\"", false,
      bases}},
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      return std::make_shared<RoughDielectric>(inputs.spectrum("index"), inputs.reflectance,
                                               facet_shape(inputs), facet_width(inputs, "roughness"));
    }};

RoughDielectric::RoughDielectric(const Spectrum& n, const Spectrum& base, FacetShape shape, double width)
    : facets_(shape, width, width), albedo_(FacetAlbedo::shared(shape, width, width)) {
  if (n.minimum() < 1.0)
    throw InputError(
        format("the refractive index of a coat is 1 or more; here it falls to {:g}", n.minimum()));
  add_spectra(n, base);
  for (const Spectrum& spectrum : spectra_)
    grey_.push_back(std::accumulate(spectrum.values().begin(), spectrum.values().end(), 0.0) /
                    static_cast<double>(spectrum.values().size()));
}

/// Everything about the surface is linear in its Fresnel reflectance by angle, but for what is reflected again.
void RoughDielectric::add_spectra(const Spectrum& n, const Spectrum& base) {
  constexpr std::size_t kRows = FresnelRows::kCount;
  std::vector<std::array<double, kRows>> once(kAngles);
  std::vector<std::array<double, kRows>> along(
      kAngles);  // the same of what is polarized in the plane of the normal
  std::vector<double> lost(kAngles);
  const VisibleFacets grid;
  parallel_for(static_cast<std::int64_t>(kAngles), 0, [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    const double cosine = std::max(1e-6, angle_cosine(k, kAngles));
    const Vec3 out{std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
    once[k].fill(0.0);
    along[k].fill(0.0);
    grid.for_each_reflection(facets_, out, [&](double weight, double at, Vec3 in) {
      const RowWeights rows = FresnelRows::at(at);
      // From the plane of both directions to that of the normal: cos of twice the angle.
      const Vec3 own{0.0, -out.x, 0.0}, facet = math::cross(out, in);
      const double along_own = math::dot(own, facet), squares = math::dot(own, own) * math::dot(facet, facet);
      const double turn = squares > 0.0 ? 2.0 * along_own * along_own / squares - 1.0 : 1.0;
      for (std::size_t i = 0; i < 4; ++i) {
        once[k][rows.first + i] += weight * rows.weight[i];
        along[k][rows.first + i] += weight * turn * rows.weight[i];
      }
    });
    lost[k] = albedo_->lost(out);
  });
  // Weights of the angles in the mean of T over a hemisphere, of the cubic between them.
  std::array<double, kAngles> mean{};
  constexpr int kSteps = 2000;
  for (int k = 0; k < kSteps; ++k) {
    const double cosine = (k + 0.5) / kSteps;
    const RowWeights rows = passed_at(cosine);
    for (std::size_t i = 0; i < 4; ++i) mean[rows.first + i] += 2.0 * cosine * rows.weight[i] / kSteps;
  }

  spectra_ = FresnelRows::of_index(n, Spectrum::constant(0.0));
  const std::vector<Spectrum> fresnel = spectra_;
  const auto again = [&](std::span<const double> v) {
    return albedo_->again_factor(
        std::inner_product(v.begin(), v.begin() + kRows, FresnelRows::mean_weights().begin(), 0.0));
  };
  spectra_.push_back(combined(fresnel, again));
  for (std::size_t k = 0; k < kAngles; ++k)
    spectra_.push_back(combined(fresnel, [&](std::span<const double> v) {
      return std::max(
          0.0, 1.0 - std::inner_product(v.begin(), v.end(), once[k].begin(), 0.0) - lost[k] * again(v));
    }));
  const std::vector<Spectrum> passed(spectra_.begin() + kPassed, spectra_.end());
  spectra_.push_back(combined(passed, [&](std::span<const double> v) {
    return std::inner_product(v.begin(), v.end(), mean.begin(), 0.0);
  }));
  polarization_ = FresnelRows::polarization_of_index(n, Spectrum::constant(0.0));
  const std::vector<Spectrum> in_plane(polarization_.begin(), polarization_.begin() + kRows);
  for (std::size_t k = 0; k < kAngles; ++k)
    polarization_.push_back(combined(in_plane, [&](std::span<const double> v) {
      return -std::inner_product(v.begin(), v.end(), along[k].begin(), 0.0);
    }));
  const Spectrum under[] = {spectra_[kMean], n, base};
  spectra_.push_back(combined(under, [](std::span<const double> v) {
    const double out = v[0] / (v[1] * v[1]);  // 1 - r
    return out * v[2] / (1.0 - (1.0 - out) * v[2]);
  }));
}

RowWeights RoughDielectric::passed_at(double cosine) {
  return cubic_weights(std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (kAngles - 1), kAngles);
}

double RoughDielectric::grey_passed(double cosine) const {
  const RowWeights rows = passed_at(cosine);
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += rows.weight[i] * grey_[kPassed + rows.first + i];
  return sum;
}

// The surface is drawn more often than it reflects: where facets graze it, it is bright.
double RoughDielectric::broad_share(Vec3 out) const { return std::clamp(grey_passed(out.z), 0.02, 0.8); }

Vec3 RoughDielectric::draw(Lobe lobe, Vec3 out, sampling::Point2 u) const {
  if (lobe == Lobe::broad) return sampling::cosine_hemisphere(u);
  const Vec3 facet = facets_.sample_visible(out, u);
  return 2.0 * math::dot(out, facet) * facet - out;
}

double RoughDielectric::density(Lobe lobe, const Directions& event) const {
  return lobe == Lobe::broad ? sampling::cosine_hemisphere_density(event.in)
                             : FacetReflection(facets_, event.out, event.in).density;
}

sampling::Point2 RoughDielectric::undraw(Lobe lobe, const Directions& event) const {
  if (lobe == Lobe::broad) return sampling::cosine_hemisphere_inverse(event.in);
  return facets_.invert_visible(event.out, math::normalized(event.out + event.in));
}

Bsdf::LobeSlopes RoughDielectric::lobe_slopes() const { return {facets_.width_x(), facets_.width_x()}; }

double RoughDielectric::narrow_grey(const Directions& event) const { return reflected(facets_, event); }

double RoughDielectric::widened_grey(const Directions& event, double slope) const {
  return reflected(facets_.widened(slope), event);
}

double RoughDielectric::reflected(const FacetDistribution& facets, const Directions& event) const {
  const FacetReflection once(facets, event.out, event.in);
  const RowWeights rows = FresnelRows::at(once.cosine);
  double fresnel = 0.0;
  for (std::size_t i = 0; i < 4; ++i) fresnel += rows.weight[i] * grey_[rows.first + i];
  return once.bsdf * fresnel;
}

double RoughDielectric::grey_bsdf(const Directions& event) const {
  return narrow_grey(event) +
         albedo_->again(albedo_->lost(event.out), albedo_->lost(event.in)) * grey_[kAgain] +
         grey_passed(event.out.z) * grey_passed(event.in.z) * inv_pi / grey_[kMean];
}

void RoughDielectric::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                               float* bsdf) const {
  const Directions directions = directions_of(event);
  const auto& [out, in] = directions;
  const FacetReflection once(facets_, out, in);
  const RowWeights fresnel = FresnelRows::at(once.cosine), there = passed_at(out.z), back = passed_at(in.z);
  std::array<float, 4> f{}, a{}, b{};
  for (std::size_t i = 0; i < 4; ++i) {
    f[i] = static_cast<float>(once.bsdf * fresnel.weight[i]);
    a[i] = static_cast<float>(there.weight[i]);
    b[i] = static_cast<float>(back.weight[i]);
  }
  const float again = static_cast<float>(albedo_->again(albedo_->lost(out), albedo_->lost(in)));
  const float* const* r = &parameters[fresnel.first];
  const float* const* p = &parameters[kPassed + there.first];
  const float* const* q = &parameters[kPassed + back.first];
  const float* __restrict more = parameters[kAgain];
  const float* __restrict mean = parameters[kMean];
  const float* __restrict base = parameters[kBase];
  for (std::size_t n = 0; n < count; ++n) {
    const float once_more =
        f[0] * r[0][n] + f[1] * r[1][n] + f[2] * r[2][n] + f[3] * r[3][n] + again * more[n];
    const float passes_out = a[0] * p[0][n] + a[1] * p[1][n] + a[2] * p[2][n] + a[3] * p[3][n];
    const float passes_in = b[0] * q[0][n] + b[1] * q[1][n] + b[2] * q[2][n] + b[3] * q[3][n];
    bsdf[n] = once_more + passes_out * passes_in * base[n] / mean[n] * static_cast<float>(inv_pi);
  }
}

void RoughDielectric::evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                                       const MuellerRows& rows) const {
  const auto [out, in] = directions_of(event);
  const FacetReflection once(facets_, out, in);
  const std::size_t own = spectra_.size();
  write_facets(FacetPlane(event), once, parameters.first(FresnelRows::kCount), parameters.subspan(own), count,
               rows);
  const RowWeights there = passed_at(out.z), back = passed_at(in.z);
  const float again = static_cast<float>(albedo_->again(albedo_->lost(out), albedo_->lost(in)));
  const auto between = [&](std::size_t table, const RowWeights& at, std::size_t n) {
    float sum = 0.0f;
    for (std::size_t i = 0; i < 4; ++i)
      sum += static_cast<float>(at.weight[i]) * parameters[table + at.first + i][n];
    return sum;
  };
  const float* __restrict more = parameters[kAgain];
  const float* __restrict mean = parameters[kMean];
  const float* __restrict base = parameters[kBase];
  for (std::size_t n = 0; n < count; ++n) {
    const float under = base[n] / mean[n] * static_cast<float>(inv_pi);
    const float leaves[] = {between(kPassed, there, n), between(own + kPassedQ, there, n)};
    const float enters = between(kPassed, back, n);
    rows.at(0, 0)[n] += again * more[n] + under * leaves[0] * enters;
    rows.at(1, 0)[n] += under * leaves[1] * enters;
    if (!rows.all) continue;
    const float enters_q = between(own + kPassedQ, back, n);
    rows.at(0, 1)[n] += under * leaves[0] * enters_q;
    rows.at(1, 1)[n] += under * leaves[1] * enters_q;
  }
}

}  // namespace ifov::materials
