#pragma once

#include "io/quantities/quantity.h"

namespace ifov::io::quantities {

/// What the radiance is made of (transport::LightPart), by channel; the first five add up to it. In the radiance unit but the
/// transmittance.
extern const Quantity kEmittedRadiance, kSunRadiance, kSkyRadiance, kSceneRadiance, kPathRadiance,
    kTransmittance;
/// Their standard errors.
extern const Quantity kEmittedRadianceError, kSunRadianceError, kSkyRadianceError, kSceneRadianceError,
    kPathRadianceError, kTransmittanceError;
/// That of what the ray through the pixel's middle meets, by channel.
extern const Quantity kEmissivity;

}  // namespace ifov::io::quantities
