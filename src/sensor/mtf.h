#pragma once

namespace ifov::sensor {

/// Modulation transfer functions along one axis, at frequencies in cycles a pixel.

/// Of a square of a side in pixels: sinc.
double square_mtf(double side_px, double cycles_px);

/// Of a Gaussian PSF.
double gaussian_mtf(double sigma_px, double cycles_px);

/// Of an aperture with a central obscuration (diameter over diameter, below 1), without aberration: O'Neill (1956), Transfer function
/// for an annular aperture, Journal of the Optical Society of America 46, 285-288. `q_px`: wavelength times f-number, in pixels; the
/// cutoff is 1 / q_px.
double diffraction_mtf(double q_px, double obscuration, double cycles_px);

}  // namespace ifov::sensor
