#pragma once

namespace ifov::atmosphere {

class AtmosphereColumn;

/// What the air sends down to the ground, 3.1 um and longer, over black ground as warm as the lowest air, W m-2: in flat layers with a
/// quadrature of directions. Scattering counts where the air has clouds. Beyond 50 um, where the band model ends, the air is taken for opaque.
double longwave_down_w_m2(const AtmosphereColumn& column, double step_cm1, int threads);

}  // namespace ifov::atmosphere
