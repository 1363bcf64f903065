#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "io/library/material_library.h"

namespace ifov::io {

/// A figure of a material's curves (positions in it), as PNG at twice the size of the screen: reflectance in
/// solid lines, transmittance dashed, both thin and pale where they were not measured, over a logarithmic
/// axis of wavelength. Throws SystemError where it cannot be drawn.
std::string plot_material(const LibraryMaterial& material, std::span<const std::size_t> curves);

}  // namespace ifov::io
