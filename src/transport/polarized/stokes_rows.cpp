#include "transport/polarized/stokes_rows.h"

#include "radiometry/polarization_frame.h"

namespace ifov::transport {

FrameTurn::FrameTurn(const radiometry::PolarizationFrame& from, const radiometry::PolarizationFrame& to) {
  const double c = dot(to.x, from.x), s = dot(to.x, from.y()), square = c * c + s * s;
  cosine = static_cast<float>((c * c - s * s) / square);
  sine = static_cast<float>(2.0 * c * s / square);
}

}  // namespace ifov::transport
