#pragma once

#include <span>

#include "atmosphere/sensor/atmosphere_error.h"
#include "atmosphere/sensor/channel_bins.h"

namespace ifov::atmosphere {

class ModelErrorTable;
struct SensorGeometry;

/// What the table makes of a channel; `optics` knows all bins.
ChannelModelError channel_model_error(const AtmosphereColumn& column, std::span<const ChannelBin> bins,
                                      const BinOptics& optics, const SensorGeometry& geometry,
                                      const ModelErrorTable& table);

}  // namespace ifov::atmosphere
