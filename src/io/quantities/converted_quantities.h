#pragma once

#include "io/quantities/quantity.h"

/// The radiance of a pixel as agencies deliver it: over the Sun's, or as a temperature.
namespace ifov::io::quantities {

extern const Quantity kToaReflectance;
extern const Quantity kToaReflectanceHalfWidth;
extern const Quantity kBrightnessTemperature;
extern const Quantity kBrightnessTemperatureHalfWidth;

}  // namespace ifov::io::quantities
