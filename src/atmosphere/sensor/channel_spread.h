#pragma once

#include <span>
#include <vector>

#include "atmosphere/scattering/ground_spread.h"

namespace ifov::radiometry {
struct Channel;
}

namespace ifov::atmosphere {

class AtmosphereColumn;
struct SensorGeometry;

/// Where the ground's light that the air scatters comes from, as one channel sees it: towards the sensor along the middle
/// line of sight, and back on the ground.
struct ChannelSpread {
  GroundSpread up, down;
};

/// By channel, each at the middle of its response: gas absorbs there as the terms that the ground is seen through do in the
/// mean. More channels have fewer photons each. Throws InputError as AtmosphereColumn::at().
std::vector<ChannelSpread> channel_spreads(const AtmosphereColumn& column,
                                           std::span<const radiometry::Channel> channels,
                                           const SensorGeometry& geometry, int threads);

}  // namespace ifov::atmosphere
