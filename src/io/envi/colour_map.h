#pragma once

#include <array>
#include <cstdint>

namespace ifov::io {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
};

/// 256 colours of equal steps in OKLab (B. Ottosson, A perceptual color space for image processing, 2020),
/// lightness growing all the way, so that they keep their order in print and for eyes that miss red or green.
using ColourMap = std::array<Rgb, 256>;

/// Blue to green to yellow, for radiances and counts.
const ColourMap& sequential_colours();
/// Violet to red to yellow, for temperatures and errors.
const ColourMap& heat_colours();

/// sRGB code of a linear intensity in [0, 1].
std::uint8_t srgb_code(double linear);

}  // namespace ifov::io
