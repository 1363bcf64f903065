#include "materials/bsdf/boundary/film.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/error.h"
#include "materials/bsdf/boundary/boundary_polarization.h"
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

namespace {

/// What a film on a substrate does with light of either polarization.
struct Coated {
  Layer film;
  Spectrum substrate_n, substrate_k;
  std::optional<double> pane_m;

  double film_um() const { return 1e6 * film.thickness_m; }
  Complex substrate(double um) const { return {substrate_n.at(um), substrate_k.at(um)}; }
  boundary_rows::Source source() const {
    return {
        {&film.n, &film.k, &substrate_n, &substrate_k}, film_um() * std::max(1.0, film.n.maximum()), true};
  }
  radiometry::FilmStack outside(double um) const {
    return {1.0, Complex(film.n.at(um), film.k.at(um)), substrate(um), film_um() / um};
  }
  /// Within the pane light is told apart from what absorbs it: the pane absorbs little where it lets light through.
  radiometry::FilmStack within(double um) const {
    return {substrate(um).real(), Complex(film.n.at(um), film.k.at(um)), 1.0, film_um() / um};
  }

  PaneFace face(double um, double cosine) const {
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const bool grazes = !(cosine > 0.0);
    PaneFace face{radiometry::film_shares(outside(um), sine), {}};
    if (grazes) face.outside = {1.0, 1.0, 0.0, 0.0};
    if (!pane_m) return face;
    face.within = radiometry::film_shares(within(um), sine);
    if (grazes) face.within = {1.0, 1.0, 0.0, 0.0};
    return face;
  }
  PaneCross cross(double um, double cosine) const {
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const CrossShares grazing{1.0, 0.0};
    const bool grazes = !(cosine > 0.0);
    PaneCross both{grazes ? grazing : film_cross(outside(um), sine), {}};
    if (pane_m) both.within = grazes ? grazing : film_cross(within(um), sine);
    return both;
  }
  double passes(double um, double cosine) const {
    return passes_once(substrate(um), cosine, 1e6 * *pane_m, um);
  }

  radiometry::PowerShares seen(double um, double cosine, bool from_behind) const {
    const PaneFace front = face(um, cosine);
    if (!pane_m) return front.outside;
    const PaneFace back = bare_face(substrate(um), cosine);
    return from_behind ? pane_shares(back, front, passes(um, cosine))
                       : pane_shares(front, back, passes(um, cosine));
  }
  CrossShares cross_seen(double um, double cosine, bool from_behind) const {
    const PaneCross front = cross(um, cosine);
    if (!pane_m) return front.outside;
    const PaneCross back = bare_cross(substrate(um), cosine);
    return from_behind ? pane_cross(back, front, passes(um, cosine))
                       : pane_cross(front, back, passes(um, cosine));
  }
};

}  // namespace

std::shared_ptr<const Bsdf> make(const Layer& film, const Spectrum& substrate_n, const Spectrum& substrate_k,
                                 std::optional<double> pane_m, const Spectrum& factor) {
  const std::size_t rows = rows_for(film);
  const auto coated = std::make_shared<const Coated>(Coated{film, substrate_n, substrate_k, pane_m});
  const auto boundary = [&](bool from_behind, std::shared_ptr<const Bsdf> behind) {
    std::vector<Spectrum> shares = boundary_rows::tabulated(
        coated->source(), rows,
        [&](double um, double cosine) { return BoundaryShares(coated->seen(um, cosine, from_behind)); });
    apply_factor(factor, rows, shares);
    DeltaBoundary::Properties properties{rows};
    if (pane_m) properties.transmits = true, properties.passage = Passage::straight;
    properties.behind = std::move(behind);
    properties.polarization = [coated, rows, from_behind] {
      return boundary_polarization::tabulated(coated->source(), boundary_polarization::rows_beside(rows),
                                              coated->pane_m.has_value(), [&](double um, double cosine) {
                                                return boundary_polarization::Polarized{
                                                    coated->seen(um, cosine, from_behind),
                                                    coated->cross_seen(um, cosine, from_behind)};
                                              });
    };
    return std::make_shared<DeltaBoundary>(std::move(shares), std::move(properties));
  };
  if (!pane_m) return boundary(false, nullptr);
  return boundary(false, boundary(true, nullptr));
}

}  // namespace ifov::materials::film
