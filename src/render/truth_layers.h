#pragma once

#include <span>

#include "sampling/tile.h"

namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}
namespace ifov::truth {
struct Collector;
}

namespace ifov::render {

/// Adds a layer to a finished tile for each collector. One ray a pixel serves all of them.
void add_truth_layers(std::span<const truth::Collector* const> collectors, const scene::Scene& scene,
                      const sensor::Camera& camera, sampling::TileResult& tile);

/// Such a layer without values in it yet.
sampling::TileLayer empty_layer(const truth::Collector& collector, std::size_t pixels);

}  // namespace ifov::render
