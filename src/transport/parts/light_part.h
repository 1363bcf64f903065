#pragma once

#include <array>
#include <cstddef>

namespace ifov::transport {

/// By where it comes from, light that a sensor gets from what it sees first; what comes through or off a pane, a mirror or water comes
/// from there. All but the last add up to the radiance.
enum class LightPart : std::size_t {
  emitted,       ///< by the surface, a lamp of its own and the medium behind it included
  sun,           ///< that of the Sun (or the Moon) that fell straight on it, or the disc itself
  sky,           ///< that of the sky which fell straight on it
  scene,         ///< that which came to it from other surfaces, whatever those had it from, and from lamps
  path,          ///< what the air before it adds, and the sky itself
  transmittance  ///< not light, but what the air before it leaves of the others: 1 before the sky itself
};
inline constexpr std::size_t kLightParts = 6, kRadianceParts = 5;

/// Spectra of all of them.
struct PartRows {
  std::array<float*, kLightParts> row{};

  float* operator[](LightPart part) const { return row[static_cast<std::size_t>(part)]; }
};

}  // namespace ifov::transport
