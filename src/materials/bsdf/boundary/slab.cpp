#include "materials/bsdf/boundary/slab.h"

#include <complex>

#include "materials/bsdf/boundary/boundary_polarization.h"
#include "materials/bsdf/boundary/delta_boundary.h"
#include "materials/bsdf/boundary/index_parameters.h"
#include "materials/bsdf/boundary/pane_shares.h"

namespace ifov::materials::slab {

using radiometry::Spectrum;

const BsdfModel kModel{
    "slab",
    "a pane of glass or plastic as one sheet: all reflections between its faces, absorption between them; light goes through it "
    "straight on. The reflectance is a factor on what is reflected, 1 where the pane is clean",
    with_numbers({{"thickness", "of the pane", BsdfParameter::Form::length, 1e-3, 1e4}}),
    [](const BsdfInputs& inputs) {
      return make(inputs.spectrum("n"), inputs.spectrum("k"), inputs.number("thickness"), inputs.reflectance);
    },
    true};

std::shared_ptr<const Bsdf> make(const Spectrum& n, const Spectrum& k, double thickness_m,
                                 const Spectrum& factor) {
  using boundary_rows::kRows;
  const double thickness_um = 1e6 * thickness_m;
  const bool absorbs = k.maximum() > 0.0;
  const boundary_rows::Source source{{&n, &k}, absorbs ? thickness_um : 0.0};
  std::vector<Spectrum> shares = boundary_rows::tabulated(source, kRows, [&](double um, double cosine) {
    const std::complex<double> index(n.at(um), k.at(um));
    const PaneFace face = bare_face(index, cosine);
    return BoundaryShares(pane_shares(face, face, passes_once(index, cosine, thickness_um, um)));
  });
  apply_factor(factor, kRows, shares);
  DeltaBoundary::Properties properties{kRows, true, Passage::straight};
  properties.polarization = [n, k, thickness_um, absorbs] {
    return boundary_polarization::tabulated(
        {{&n, &k}, absorbs ? thickness_um : 0.0}, boundary_polarization::rows_beside(kRows), true,
        [&](double um, double cosine) {
          const std::complex<double> index(n.at(um), k.at(um));
          const PaneFace face = bare_face(index, cosine);
          const PaneCross cross = bare_cross(index, cosine);
          const double passes = passes_once(index, cosine, thickness_um, um);
          return boundary_polarization::Polarized{pane_shares(face, face, passes),
                                                  pane_cross(cross, cross, passes)};
        });
  };
  return std::make_shared<DeltaBoundary>(std::move(shares), std::move(properties));
}

}  // namespace ifov::materials::slab
