#pragma once

#include <span>

#include "sampling/tile.h"

namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class SpectralScene;
}
namespace ifov::truth {
struct Collector;
}

namespace ifov::render {

/// Adds a layer to a finished tile for each collector. One ray a pixel serves all of them.
void add_truth_layers(std::span<const truth::Collector* const> collectors, const scene::Scene& scene,
                      const sensor::Camera& camera, sampling::TileResult& tile);

/// Layer of a tile with the emissivity, by channel (means over responses), of what the ray through each pixel's middle meets first: towards the sensor, what directional-hemispherical
/// reflectance and transmittance leave of 1 (Kirchhoff); of materials that share the place weighed by area. Not numbers where it meets nothing. Floats, [pixel][channel].
inline constexpr const char* kEmissivityLayer = "emissivity";
/// Such a layer without values in it yet.
void add_empty_emissivity_layer(std::size_t channels, sampling::TileResult& tile);
/// Adds it, before channels are made of what paths carry (make_channels()).
void add_emissivity_layer(const transport::SpectralScene& scene, const sensor::Camera& camera,
                          sampling::TileResult& tile);

/// A collector's layer without values in it yet.
sampling::TileLayer empty_layer(const truth::Collector& collector, std::size_t pixels);

}  // namespace ifov::render
