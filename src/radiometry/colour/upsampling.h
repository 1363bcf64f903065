#pragma once

#include <array>
#include <string>

#include "radiometry/colour/colorimetry.h"
#include "radiometry/spectrum.h"

namespace ifov::radiometry {

/// A reflectance made of a colour: S(t) = 1/2 + x / (2 sqrt(1 + x^2)) with x = c0 t^2 + c1 t + c2 (Jakob and Hanika 2019, A
/// Low-Dimensional Function Space for Efficient Spectral Upsampling, Computer Graphics Forum 38), here with t from 0 at 0.38 to 1 at
/// 0.78 um. Smooth and within 0 to 1; one of infinitely many that look like the colour in daylight.
struct ColourSpectrum {
  std::array<double, 3> c{};
  /// Of grey colours, black and white among them: the same for all wavelengths, the limit of the above; c is not meant then.
  bool is_grey = false;
  double grey = 0.0;
  double difference = 0.0;  ///< Delta E*ab between the colour asked for and that of this spectrum

  double at(double um) const;
  /// A table at colour_wavelengths_um(); beyond, its ends go on, which is a guess.
  Spectrum spectrum(std::string name) const;
};

/// For a colour of linear sRGB within 0 to 1, seen under D65 by the CIE 1931 observer: damped Gauss-Newton steps on the three residuals
/// of its linear values, along a line from the grey of its luminance.
ColourSpectrum upsampled(const LinearRgb& rgb);

}  // namespace ifov::radiometry
