#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "radiometry/spectrum.h"

namespace ifov::radiometry {

/// Red, green and blue in proportion to light, 0 to 1: sRGB (IEC 61966-2-1) before its coding.
using LinearRgb = std::array<double, 3>;
/// CIE 1931 tristimulus values; Y is 1 of a white surface.
using Tristimulus = std::array<double, 3>;

/// The linear value of a code of sRGB, 0 to 1 (IEC 61966-2-1:1999, 4.8: c / 12.92 up to 0.04045, else ((c + 0.055) / 1.055)^2.4),
/// and the way back.
double srgb_decoded(double code);
double srgb_coded(double linear);

inline constexpr std::size_t kColourPoints = 81;
/// Where colours are told from spectra: 81 wavelengths from 0.38 to 0.78 um, 5 nm apart.
std::span<const double> colour_wavelengths_um();

/// Of a surface's reflectance under D65, by the CIE 1931 standard observer (data/colorimetry.csv): sums over colour_wavelengths_um(),
/// relative to a white surface. A reflectance has to be known there.
Tristimulus tristimulus_under_d65(const Spectrum& reflectance);
/// Linear sRGB of these: primaries of IEC 61966-2-1, and as white the sum of the same tables over D65, so that a grey surface is
/// grey without rounding (0.9504, 1, 1.0888; the standard's own matrix rounds it to four digits).
LinearRgb linear_srgb(const Tristimulus& xyz);
Tristimulus tristimulus_of(const LinearRgb& rgb);
inline LinearRgb linear_srgb_of(const Spectrum& reflectance) {
  return linear_srgb(tristimulus_under_d65(reflectance));
}

/// By colour of linear sRGB, the factors that reflectances at colour_wavelengths_um() are summed up with.
const std::array<std::array<double, kColourPoints>, 3>& srgb_weights();

/// CIELAB, white as above (ISO/CIE 11664-4), and the Euclidean distance in it, Delta E*ab of 1976 (11664-4 as well).
std::array<double, 3> cielab(const Tristimulus& xyz);
double colour_difference(const LinearRgb& a, const LinearRgb& b);

}  // namespace ifov::radiometry
