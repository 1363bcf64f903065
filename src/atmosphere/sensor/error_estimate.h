#pragma once

#include <span>
#include <vector>

#include "atmosphere/sensor/atmosphere_error.h"
#include "atmosphere/sensor/channel_bins.h"
#include "atmosphere/sensor/channel_lights.h"
#include "atmosphere/sensor/finer_atmosphere.h"
#include "atmosphere/sensor/kept_solutions.h"

namespace ifov::atmosphere {

struct ErrorQuestion {
  const AtmosphereColumn& column;
  const FinerAtmosphere& finer;
  const SensorGeometry& geometry;
  const SkyDirections& directions;
  const ScatteringOptions& scattering;
  std::span<const radiometry::Spectrum> grounds;  ///< by channel, reflectance of the ground around the scene
  int threads = 0;
  KeptSolutions* kept = nullptr;  ///< estimates from before, if any
};

/// Errors of solved channels by where they come from, all but that of the nodes
/// (docs/theory/atmosphere_error.md).
std::vector<AtmosphereErrors> estimate_errors(const ErrorQuestion& question,
                                              std::span<const std::vector<ChannelBin>> bins,
                                              std::span<const ChannelLights> channels);

}  // namespace ifov::atmosphere
