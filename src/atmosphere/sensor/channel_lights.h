#pragma once

#include <optional>

#include "atmosphere/sensor/channel_checks.h"
#include "atmosphere/sensor/channel_emission.h"
#include "atmosphere/sensor/channel_points.h"
#include "atmosphere/sensor/channel_scattering.h"

namespace ifov::atmosphere {

/// All that is known of a channel at its points; `scattered` and `emitted` once it is solved.
struct ChannelLights {
  ChannelPoints points;
  std::optional<ChannelScattering> scattering = {};
  ChannelScattering::AtPoints scattered = {};
  std::optional<ChannelEmission> emitted = {};
  std::optional<ChannelChecks> checks = {};

  /// Of a level surface, by point.
  std::vector<double> sky_irradiance() const;
};

}  // namespace ifov::atmosphere
