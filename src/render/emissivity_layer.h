#pragma once

#include <cstddef>

namespace ifov::sampling {
struct TileResult;
}

namespace ifov::render {

/// Layer of a tile with the emissivity, by channel, of what the ray through each pixel's middle meets first: towards the sensor, by
/// Kirchhoff's law what its directional-hemispherical reflectance and transmittance leave of 1; materials that share the place are
/// weighed by area. Means over the channels' responses. Not numbers where the ray meets nothing. Floats, [pixel][channel].
inline constexpr const char* kEmissivityLayer = "emissivity";

/// Such a layer without values in it yet.
void add_empty_emissivity_layer(std::size_t channels, sampling::TileResult& tile);

}  // namespace ifov::render
