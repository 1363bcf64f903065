#pragma once

#include <optional>

#include "materials/bsdf/bsdf_model.h"

namespace ifov::materials {

/// A thin film on a substrate: waves that go to and fro in it interfere (Born and Wolf, section 7.6.1). The substrate swallows what
/// enters it, or is a pane whose other face is bare, and which is seen otherwise from there.
namespace film {

extern const BsdfModel kModel;

struct Layer {
  radiometry::Spectrum n, k;
  double thickness_m = 0.0;
};
/// `pane_m`: thickness of a pane; none: an absorber.
std::shared_ptr<const Bsdf> make(const Layer& film, const radiometry::Spectrum& substrate_n,
                                 const radiometry::Spectrum& substrate_k, std::optional<double> pane_m,
                                 const radiometry::Spectrum& factor);

}  // namespace film

}  // namespace ifov::materials
