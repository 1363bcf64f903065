#pragma once

#include "ifov/api.h"

namespace ifov {

/// Spectral radiance of a black body, W m-2 sr-1 um-1 (Planck's law; CODATA 2018 constants, which are exact). 0 at and below
/// 0 K and wherever the result is below the range of double.
IFOV_API double planck_radiance(double wavelength_um, double temperature_k);

/// The temperature, K, at which a black body has this radiance: the exact inverse. 0 for radiance <= 0.
IFOV_API double brightness_temperature(double wavelength_um, double radiance);

}  // namespace ifov
