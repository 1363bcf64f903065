#pragma once

namespace ifov::radiometry {

/// Spectral radiance of a blackbody, W m-2 sr-1 um-1 (Planck's law; CODATA 2018 constants, which are exact).
/// 0 at and below 0 K and wherever the result is below the range of double.
double planck_w_m2_sr_um(double wavelength_um, double temperature_k);

/// Its derivative by temperature, W m-2 sr-1 um-1 K-1.
double planck_slope_w_m2_sr_um_k(double wavelength_um, double temperature_k);

/// The temperature at which a blackbody has this radiance: the exact inverse. 0 for radiance <= 0.
double brightness_temperature_k(double wavelength_um, double radiance_w_m2_sr_um);

}  // namespace ifov::radiometry
