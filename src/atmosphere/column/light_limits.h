#pragma once

namespace ifov::atmosphere {

/// Air does not glow at shorter wavelengths (below 1e-4 of sunlight), and sunlight that it scatters does not
/// count at longer ones (below 1e-4 of what it emits).
inline constexpr double kFirstThermal_um = 2.4, kLastSolar_um = 6.0;

}  // namespace ifov::atmosphere
