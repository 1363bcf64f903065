#include "materials/bsdf/boundary/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "materials/bsdf/boundary/boundary_polarization.h"
#include "materials/bsdf/boundary/delta_boundary.h"
#include "materials/bsdf/boundary/index_parameters.h"
#include "materials/bsdf/boundary/pane_shares.h"
#include "materials/bsdf/facet_parameters.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"

namespace ifov::materials::smooth {
namespace {

using radiometry::Spectrum;

constexpr double kPerMetre = 1e6;  // of 1/um

}  // namespace

std::span<const std::string_view> bases() {
  static constexpr std::array<std::string_view, 2> kWords{"medium", "absorber"};
  return kWords;
}

const BsdfModel kModel{
    "smooth",
    "a smooth boundary by Fresnel's equations: glass or water with an inside, into which light is refracted, or, over an absorber, "
    "polished metal and still deep water; the reflectance is a factor on what is reflected, 1 where the surface is clean",
    with_index(
        {{"over",
          "what lies behind: a `medium` that light goes on in, of a solid with an inside; or an `absorber`, where it ends. "
          "Without it, a medium unless light ends in it within 0.1 mm at all wavelengths of the index",
          BsdfParameter::Form::word,
          0.0,
          0.0,
          {},
          true,
          bases}}),
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      const IndexSpectra index = refractive_index(inputs);
      const bool medium =
          inputs.has("over") ? inputs.word("over") == "medium" : !medium_of(index.n, index.k).is_opaque;
      if (medium) refuse_name(inputs, "index", "n", "k");
      return make(index.n, index.k, inputs.reflectance, medium);
    },
    true};

Medium medium_of(const Spectrum& n, const Spectrum& k) {
  constexpr double kOpaque = 1e4;  // 1/m
  Medium medium;
  const Spectrum* const both[] = {&n, &k};
  radiometry::CommonWavelengths common = radiometry::common_wavelengths(both);
  if (common.um.empty()) {
    medium.index = n.at(1.0);
    const double at_1um = k.at(1.0);
    medium.is_opaque = 4.0 * std::numbers::pi * at_1um * kPerMetre > kOpaque;
    if (at_1um == 0.0) {
      medium.absorption = Spectrum::constant(0.0);
      return medium;
    }
    // Straight between points 5 % apart within 6e-4 of itself.
    for (double um = 0.1; um < 1000.0; um *= 1.05) common.um.push_back(um);
  }
  std::vector<double> um, per_m;
  double least = std::numeric_limits<double>::infinity();
  const auto add = [&](double at) {
    um.push_back(at);
    per_m.push_back(4.0 * std::numbers::pi * k.at(at) / at * kPerMetre);
    if (per_m.back() < least) least = per_m.back(), medium.index = n.at(at);
  };
  for (std::size_t i = 0; i < common.um.size(); ++i) {
    add(common.um[i]);
    if (i + 1 == common.um.size()) break;
    const double ratio = common.um[i + 1] / common.um[i];
    const int steps = static_cast<int>(std::ceil(std::log(ratio) / 0.05));
    for (int s = 1; s < steps; ++s) add(common.um[i] * std::pow(ratio, static_cast<double>(s) / steps));
  }
  medium.is_opaque = least > kOpaque;
  medium.absorption = Spectrum(std::move(um), std::move(per_m), common.outside, k.name());
  return medium;
}

std::shared_ptr<const Bsdf> make(const Spectrum& n, const Spectrum& k, const Spectrum& factor,
                                 bool over_medium) {
  using boundary_rows::kRows;
  const boundary_rows::Source source{{&n, &k}};
  std::vector<Spectrum> shares = boundary_rows::tabulated(source, kRows, [&](double um, double cosine) {
    const radiometry::FresnelAmplitudes r =
        radiometry::fresnel_reflection_amplitudes({n.at(um), k.at(um)}, cosine);
    const double p = std::norm(r.p), s = std::norm(r.s);
    return BoundaryShares({p, s, 1.0 - p, 1.0 - s});
  });
  apply_factor(factor, kRows, shares);
  const auto polarization = [n, k](bool transmits) {
    return boundary_polarization::tabulated(
        {{&n, &k}}, boundary_polarization::rows_beside(kRows), transmits, [&](double um, double cosine) {
          const std::complex<double> index(n.at(um), k.at(um));
          return boundary_polarization::Polarized{bare_face(index, cosine).outside,
                                                  bare_cross(index, cosine).outside};
        });
  };
  if (!over_medium) {
    DeltaBoundary::Properties alone{kRows};
    alone.polarization = [polarization] { return polarization(false); };
    return std::make_shared<DeltaBoundary>(shares, std::move(alone));
  }
  const Medium medium = medium_of(n, k);
  DeltaBoundary::Properties within{kRows, true, Passage::out_of, medium.index};
  within.polarization = [polarization, n] {
    std::vector<Spectrum> all = polarization(true);
    all.push_back(n);
    return all;
  };
  DeltaBoundary::Properties outside{kRows,
                                    true,
                                    Passage::into,
                                    medium.index,
                                    medium.absorption,
                                    std::make_shared<DeltaBoundary>(shares, within)};
  outside.polarization = [polarization] { return polarization(true); };
  if (outside.absorption->maximum() <= 0.0) outside.absorption.reset();
  return std::make_shared<DeltaBoundary>(std::move(shares), outside);
}

}  // namespace ifov::materials::smooth
