#pragma once

#include "io/quantities/quantity.h"

/// The radiance of a pixel as agencies deliver it: in other units, over the Sun's, or as a temperature.
namespace ifov::io::quantities {

extern const Quantity kRadiancePerNm;  ///< uW cm-2 sr-1 nm-1
extern const Quantity kRadiancePerNmHalfWidth;
extern const Quantity kBandRadiance;  ///< W m-2 sr-1, within the response scaled to a maximum of 1
extern const Quantity kBandRadianceHalfWidth;
extern const Quantity
    kPhotonRadiance;  ///< photons s-1 m-2 sr-1 um-1, of radiance that is even over the channel
extern const Quantity kPhotonRadianceHalfWidth;
extern const Quantity kToaReflectance;
extern const Quantity kToaReflectanceHalfWidth;
extern const Quantity kBrightnessTemperature;
extern const Quantity kBrightnessTemperatureHalfWidth;

}  // namespace ifov::io::quantities
