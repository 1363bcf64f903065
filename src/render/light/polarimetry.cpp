#include "render/light/polarimetry.h"

#include "radiometry/mueller.h"

namespace ifov::render {

double Polarimetry::passed(std::size_t channel) const { return optics ? (*optics)[channel](0, 0) : 1.0; }

}  // namespace ifov::render
