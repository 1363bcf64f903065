#include "materials/indices/ice.h"

#include "radiometry/refractive_index.h"

namespace ifov::materials {

const radiometry::Spectrum& ice_extinction_index() { return radiometry::whole_refractive_index("ice")->k; }

}  // namespace ifov::materials
