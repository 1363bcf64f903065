#pragma once

#include <optional>

#include "atmosphere/sensor/channel_checks.h"
#include "atmosphere/sensor/channel_emission.h"
#include "atmosphere/sensor/channel_points.h"
#include "atmosphere/sensor/channel_scattering.h"
#include "atmosphere/thermal/scattered_emission.h"

namespace ifov::atmosphere {

/// All that is known of a channel at its points; `scattered` and `emitted` once it is solved.
struct ChannelLights {
  ChannelPoints points;
  std::optional<ChannelScattering> scattering = {};
  ChannelScattering::AtPoints scattered = {};
  std::optional<ScatteredEmission> own_scattering = {};  ///< of light that the air emits; none where none is
  std::optional<ChannelEmission> emitted = {};
  std::optional<ChannelChecks> checks = {};

  /// Asks for what the air scatters of its own light, where it does.
  void ask_for_own_scattering(const AtmosphereColumn& column, const ScatteringOptions& options);
  /// What the channel's air emits, with what it scatters of that.
  ChannelEmission emission(const AtmosphereColumn& column, const SensorGeometry& geometry,
                           const SkyDirections& directions) const;
  /// Of a level surface, by point.
  std::vector<double> sky_irradiance() const;
};

}  // namespace ifov::atmosphere
