#include "materials/bsdf/boundary/rough_boundary.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "materials/bsdf/boundary/index_parameters.h"
#include "materials/bsdf/boundary/rough_boundary_tables.h"
#include "materials/bsdf/facet_parameters.h"
#include "materials/bsdf/microfacet/facet_reflection.h"
#include "materials/bsdf/microfacet/facet_refraction.h"
#include "math/frame.h"

namespace ifov::materials {

using math::Vec3;
using Tables = RoughBoundaryTables;

namespace {

/// Keys of an index that bends light.
std::vector<BsdfParameter> with_bending(std::vector<BsdfParameter> others) {
  std::vector<BsdfParameter> all = with_numbers(std::move(others));
  all.front().low = 1.01;
  return all;
}

}  // namespace

const BsdfModel RoughBoundary::kModel{
    "rough_boundary",
    "a rough boundary of glass, ice or water with an inside, which reflects and refracts (Walter et al. 2007): ground glass, a ruffled pool. The "
    "reflectance is a factor on what is reflected, 1 where the surface is clean",
    with_bending({{"roughness", "width of the distribution of the surface's slopes",
                   BsdfParameter::Form::number, 0.0, 1.0},
                  {"distribution", "of the slopes: `ggx`, with long tails, or `beckmann`, Gaussian",
                   BsdfParameter::Form::word, 0.0, 0.0, "\"ggx\"", false, facet_shapes}}),
    [](const BsdfInputs& inputs) {
      return make(inputs.spectrum("n"), inputs.spectrum("k"), inputs.reflectance,
                  {facet_shape(inputs), facet_width(inputs, "roughness")});
    },
    true};

std::shared_ptr<const Bsdf> RoughBoundary::make(const radiometry::Spectrum& n, const radiometry::Spectrum& k,
                                                const radiometry::Spectrum& factor, const Surface& surface) {
  const auto tables = std::make_shared<const Tables>(n, k, factor, surface);
  return std::make_shared<RoughBoundary>(tables, false,
                                         std::make_shared<RoughBoundary>(tables, true, nullptr));
}

RoughBoundary::RoughBoundary(std::shared_ptr<const Tables> tables, bool from_within,
                             std::shared_ptr<const Bsdf> behind)
    : tables_(std::move(tables)), from_within_(from_within), behind_(std::move(behind)) {}

double RoughBoundary::bending_index() const { return tables_->index; }

const radiometry::Spectrum* RoughBoundary::absorption() const {
  return !from_within_ && tables_->absorption ? &*tables_->absorption : nullptr;
}

std::span<const radiometry::Spectrum> RoughBoundary::spectra() const { return tables_->spectra; }

double RoughBoundary::ratio() const { return from_within_ ? 1.0 / tables_->index : tables_->index; }

RoughBoundary::Local RoughBoundary::local(const BsdfEvent& event) {
  const math::Frame frame = math::frame_from_normal(event.normal);
  return {frame.local_from_outer(event.outgoing), frame.local_from_outer(event.incoming),
          event.side == Side::transmitted};
}

RoughBoundary::Once RoughBoundary::once(const FacetDistribution& facets, const Local& event) const {
  if (event.through) {
    const FacetRefraction bent(facets, event.out, event.in, ratio());
    return {bent.bsdf, bent.density, from_within_ ? bent.cosine_in : bent.cosine_out};
  }
  const FacetReflection back(facets, event.out, event.in);
  double outside = back.cosine;
  if (from_within_)
    outside = std::sqrt(std::max(0.0, 1.0 - tables_->index * tables_->index * (1.0 - outside * outside)));
  return {back.bsdf, back.density, outside};
}

const CosineLobe& RoughBoundary::diffuse(bool through) const {
  return tables_->diffuse[from_within_ != through ? 1 : 0];
}

double RoughBoundary::broad_share(bool through, double cosine) const {
  return Tables::share_at(tables_->broad[from_within_ ? 1 : 0][through ? 1 : 0], cosine);
}

double RoughBoundary::density(const Local& event, double broad) const {
  return broad * diffuse(event.through).density(std::abs(event.in.z)) +
         (1.0 - broad) * once(tables_->facets, event).density;
}

BsdfSample RoughBoundary::sample(const BsdfEvent& view, double u1, double u2) const {
  const math::Frame frame = math::frame_from_normal(view.normal);
  Local event{frame.local_from_outer(view.outgoing), {}, view.side == Side::transmitted};
  const double broad = broad_share(event.through, event.out.z);
  if (u1 < broad) {
    event.in = diffuse(event.through).sample({u1 / broad, u2});
    if (event.through) event.in.z = -event.in.z;
  } else {
    const Vec3 facet = tables_->facets.sample_visible(event.out, {(u1 - broad) / (1.0 - broad), u2});
    event.in = event.through ? refracted_by(facet, event.out, ratio())
                             : 2.0 * math::dot(event.out, facet) * facet - event.out;
  }
  if (!event.is_possible()) return {};
  BsdfSample sample{math::normalized(frame.outer_from_local(event.in)), 0.0, density(event, broad)};
  sample.weight = sample.pdf > 0.0 ? std::abs(event.in.z) / sample.pdf : 0.0;
  return sample;
}

double RoughBoundary::pdf(const BsdfEvent& event) const {
  const Local at = local(event);
  return at.is_possible() ? density(at, broad_share(at.through, at.out.z)) : 0.0;
}

UnitSquarePoint RoughBoundary::invert(const BsdfEvent& event) const {
  const Local at = local(event);
  const double broad = broad_share(at.through, at.out.z);
  const Vec3 upright{at.in.x, at.in.y, std::abs(at.in.z)};
  if (broad * diffuse(at.through).density(upright.z) > (1.0 - broad) * once(tables_->facets, at).density) {
    const sampling::Point2 u = diffuse(at.through).invert(upright);
    return {broad * u.x, u.y};
  }
  const Vec3 facet = at.through ? refracting_facet(at.out, at.in, ratio()) : math::normalized(at.out + at.in);
  const sampling::Point2 u = tables_->facets.invert_visible(at.out, facet);
  return {broad + (1.0 - broad) * u.x, u.y};
}

double RoughBoundary::seam(const BsdfEvent& view) const {
  return broad_share(view.side == Side::transmitted, view.outgoing_cosine());
}

double RoughBoundary::from_there() const {
  return from_within_ ? 1.0 / (tables_->index * tables_->index) : 1.0;
}

double RoughBoundary::grey_once(const FacetDistribution& facets, const Local& event) const {
  const Once found = once(facets, event);
  const RowWeights rows = FresnelRows::at(found.outside);
  const std::size_t first = (event.through ? Tables::kThrough : Tables::kReflected) + rows.first;
  double share = 0.0;
  for (std::size_t i = 0; i < 4; ++i) share += rows.weight[i] * tables_->grey[first + i];
  return found.bsdf * share;
}

double RoughBoundary::grey(const BsdfEvent& event) const {
  const Local at = local(event);
  if (!at.is_possible()) return 0.0;
  const std::size_t own = from_within_ ? 1 : 0, other = at.through ? 1 - own : own;
  const RowWeights there = Tables::angle_at(at.out.z), back = Tables::angle_at(std::abs(at.in.z));
  double out = 0.0, in = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    out += there.weight[i] * tables_->grey[Tables::kLost + own * Tables::kAngles + there.first + i];
    in += back.weight[i] * tables_->grey[Tables::kLost + other * Tables::kAngles + back.first + i];
  }
  const double again = at.through ? tables_->grey[Tables::kAgainThrough] * from_there()
                                  : tables_->grey[Tables::kAgainReflected + own];
  return grey_once(tables_->facets, at) + std::max(0.0, out) * std::max(0.0, in) * again;
}

Bsdf::LobeSlopes RoughBoundary::lobe_slopes() const {
  return {tables_->facets.width_x(), tables_->facets.width_x()};
}

double RoughBoundary::lobe_share(const BsdfEvent& event) const {
  const Local at = local(event);
  if (at.through || !at.is_possible()) return 0.0;
  const double all = grey(event);
  return all > 0.0 ? grey_once(tables_->facets, at) / all : 0.0;
}

double RoughBoundary::widened_lobe(const BsdfEvent& event, double slope) const {
  const Local at = local(event);
  return at.through || !at.is_possible() ? 0.0 : grey_once(tables_->facets.widened(slope), at);
}

double RoughBoundary::passed_spread() const { return (tables_->index - 1.0) * tables_->facets.width_x(); }

double RoughBoundary::through_share(const BsdfEvent& view) const {
  constexpr double kLeast = 0.02;  // no side is never asked
  const double through = Tables::share_at(tables_->passed[from_within_ ? 1 : 0], view.outgoing_cosine());
  return std::clamp(through, kLeast, 1.0 - kLeast);
}

void RoughBoundary::add_again(const Local& at, ParameterSpectra parameters, std::size_t count,
                              float* bsdf) const {
  const std::size_t own = from_within_ ? 1 : 0, other = at.through ? 1 - own : own;
  const RowWeights there = Tables::angle_at(at.out.z), back = Tables::angle_at(std::abs(at.in.z));
  float a[4], b[4];
  for (std::size_t i = 0; i < 4; ++i) {
    a[i] = static_cast<float>(there.weight[i]);
    b[i] = static_cast<float>(back.weight[i]);
  }
  const float* const* p = &parameters[Tables::kLost + own * Tables::kAngles + there.first];
  const float* const* q = &parameters[Tables::kLost + other * Tables::kAngles + back.first];
  const float* __restrict again =
      parameters[at.through ? Tables::kAgainThrough : Tables::kAgainReflected + own];
  const float scale = at.through ? static_cast<float>(from_there()) : 1.0f;
  for (std::size_t n = 0; n < count; ++n) {
    const float out = a[0] * p[0][n] + a[1] * p[1][n] + a[2] * p[2][n] + a[3] * p[3][n];
    const float in = b[0] * q[0][n] + b[1] * q[1][n] + b[2] * q[2][n] + b[3] * q[3][n];
    bsdf[n] += std::max(0.0f, out) * std::max(0.0f, in) * again[n] * scale;
  }
}

void RoughBoundary::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                             float* bsdf) const {
  const Local at = local(event);
  if (!at.is_possible()) {
    std::fill_n(bsdf, count, 0.0f);
    return;
  }
  const Once found = once(tables_->facets, at);
  const RowWeights fresnel = FresnelRows::at(found.outside);
  float f[4];
  for (std::size_t i = 0; i < 4; ++i) f[i] = static_cast<float>(found.bsdf * fresnel.weight[i]);
  const float* const* r = &parameters[(at.through ? Tables::kThrough : Tables::kReflected) + fresnel.first];
  for (std::size_t n = 0; n < count; ++n)
    bsdf[n] = std::max(0.0f, f[0] * r[0][n] + f[1] * r[1][n] + f[2] * r[2][n] + f[3] * r[3][n]);
  add_again(at, parameters, count, bsdf);
}

}  // namespace ifov::materials
