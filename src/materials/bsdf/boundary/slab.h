#pragma once

#include "materials/bsdf/bsdf_model.h"

namespace ifov::materials {

/// A pane of glass as one sheet: light that goes to and fro between its two faces adds up without interference, and is absorbed
/// on its way (Beer). What is reflected leaves as from a mirror, what goes through goes straight on.
namespace slab {

extern const BsdfModel kModel;

std::shared_ptr<const Bsdf> make(const radiometry::Spectrum& n, const radiometry::Spectrum& k,
                                 double thickness_m, const radiometry::Spectrum& factor);

}  // namespace slab

}  // namespace ifov::materials
