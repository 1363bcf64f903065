#include "materials/bsdf/boundary/film.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/error.h"
#include "materials/bsdf/boundary/boundary_rows.h"
#include "materials/bsdf/boundary/delta_boundary.h"
#include "materials/bsdf/boundary/index_parameters.h"
#include "materials/bsdf/boundary/pane_shares.h"
#include "materials/bsdf/facet_parameters.h"
#include "radiometry/refractive_index.h"

namespace ifov::materials::film {
namespace {

using radiometry::Spectrum;
using Complex = std::complex<double>;

IndexSpectra substrate_of(const BsdfInputs& inputs) {
  const bool by_name = inputs.has("substrate"),
             by_value = inputs.has("substrate_n") || inputs.has("substrate_k");
  if (by_name && by_value)
    throw InputError(
        "the index of the substrate is given either by its name, 'substrate', or as 'substrate_n' and 'substrate_k', not "
        "by both");
  if (by_name) {
    const radiometry::RefractiveIndex& found = radiometry::refractive_index(inputs.word("substrate"));
    return {found.n, found.k};
  }
  if (!inputs.has("substrate_n") || !inputs.has("substrate_k"))
    throw InputError(
        "the index of the substrate is missing: it is given by its name, 'substrate', or as 'substrate_n' and 'substrate_k'");
  return {inputs.spectrum("substrate_n"), inputs.spectrum("substrate_k")};
}

/// Rows by angle: as many as fringes need at 0.3 um, the shortest wavelength at which a surface is usually seen.
std::size_t rows_for(const Layer& film) {
  constexpr double kShortest_um = 0.3, kPerFringe = 16.0;
  constexpr std::size_t kMost = 129;
  const double n = std::max(1.0, film.n.maximum());
  const double fringes =
      2.0 * 1e6 * film.thickness_m * (n - std::sqrt(std::max(0.0, n * n - 1.0))) / kShortest_um;
  return std::min(kMost, boundary_rows::kRows + static_cast<std::size_t>(kPerFringe * fringes));
}

}  // namespace

const BsdfModel kModel{
    "film",
    "a thin film, in which light interferes, on a substrate: coatings against reflection or for heat, oxide on metal; on a pane "
    "light goes through it straight on. The reflectance is a factor on what is reflected, 1 where it is clean",
    with_index(
        {{"thickness", "of the film", BsdfParameter::Form::length, 1e-7, 5e-3},
         {"substrate",
          "name of the refractive index of what is under the film",
          BsdfParameter::Form::word,
          0.0,
          0.0,
          {},
          true,
          radiometry::refractive_index_names},
         {"substrate_n",
          "its real part, in place of a name",
          BsdfParameter::Form::spectrum,
          0.01,
          1000.0,
          {},
          true},
         {"substrate_k", "its imaginary part", BsdfParameter::Form::spectrum, 0.0, 1000.0, {}, true},
         {"pane",
          "thickness of the substrate, if it is a pane with a bare back; without it, what enters it ends there",
          BsdfParameter::Form::length,
          1e-3,
          1e4,
          {},
          true}}),
    [](const BsdfInputs& inputs) {
      if (inputs.has("pane")) refuse_name(inputs, "substrate", "substrate_n", "substrate_k");
      const IndexSpectra index = refractive_index(inputs), substrate = substrate_of(inputs);
      return make({index.n, index.k, inputs.number("thickness")}, substrate.n, substrate.k,
                  inputs.has("pane") ? std::optional(inputs.number("pane")) : std::nullopt,
                  inputs.reflectance);
    },
    true};

std::shared_ptr<const Bsdf> make(const Layer& film, const Spectrum& substrate_n, const Spectrum& substrate_k,
                                 std::optional<double> pane_m, const Spectrum& factor) {
  const double film_um = 1e6 * film.thickness_m, pane_um = 1e6 * pane_m.value_or(0.0);
  const std::size_t rows = rows_for(film);
  const double optical_um = film_um * std::max(1.0, film.n.maximum());
  const boundary_rows::Source source{{&film.n, &film.k, &substrate_n, &substrate_k}, optical_um, true};
  const auto coated = [&](double um, double cosine) {
    const Complex layer(film.n.at(um), film.k.at(um)), substrate(substrate_n.at(um), substrate_k.at(um));
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), waves = film_um / um;
    PaneFace face{radiometry::film_shares({1.0, layer, substrate, waves}, sine), {}};
    if (!(cosine > 0.0)) face.outside = {1.0, 1.0, 0.0, 0.0};
    if (!pane_m) return face;
    // Within the pane light is told apart from what absorbs it: the pane absorbs little where it lets light through.
    face.within = radiometry::film_shares({substrate.real(), layer, 1.0, waves}, sine);
    if (!(cosine > 0.0)) face.within = {1.0, 1.0, 0.0, 0.0};
    return face;
  };
  const auto seen = [&](bool from_behind) {
    std::vector<Spectrum> shares = boundary_rows::tabulated(source, rows, [&](double um, double cosine) {
      const PaneFace front = coated(um, cosine);
      if (!pane_m) return BoundaryShares(front.outside);
      const Complex substrate(substrate_n.at(um), substrate_k.at(um));
      const PaneFace back = bare_face(substrate, cosine);
      const double passes = passes_once(substrate, cosine, pane_um, um);
      return BoundaryShares(from_behind ? pane_shares(back, front, passes)
                                        : pane_shares(front, back, passes));
    });
    apply_factor(factor, rows, shares);
    return shares;
  };
  if (!pane_m) return std::make_shared<DeltaBoundary>(seen(false), DeltaBoundary::Properties{rows});
  DeltaBoundary::Properties properties{rows, true, Passage::straight};
  properties.behind = std::make_shared<DeltaBoundary>(seen(true), properties);
  return std::make_shared<DeltaBoundary>(seen(false), properties);
}

}  // namespace ifov::materials::film
