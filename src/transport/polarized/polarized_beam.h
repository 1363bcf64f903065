#pragma once

#include "radiometry/polarization_frame.h"
#include "transport/polarized/stokes_rows.h"

namespace ifov::transport {

/// Light on its way, of which Q, U and V mean nothing where it is not polarized.
struct PolarizedBeam {
  StokesRows rows;
  bool any = false, polarized = false;
  radiometry::PolarizationFrame frame;
};

}  // namespace ifov::transport
