#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "render/tolerance/node_half_width.h"

namespace ifov::sampling {
struct Abundance;
struct TileLayer;
struct TileResult;
}  // namespace ifov::sampling
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

class AccuracyTolerance;

/// By channel, of the errors that the nodes' own checks found.
std::vector<NodeHalfWidth> node_half_widths(const transport::SpectralScene& scene);

/// Of `emitted`, of a pixel that holds `count` materials: each as much as it may have of the pixel; of what is not told the worst.
double emitted_by(const NodeHalfWidth& node, const sampling::Abundance* held, std::size_t count);

/// Layer of a tile with how far its radiance may be off because temperatures that were solved are what they are, by channel, of
/// what materials each pixel holds. It is in half-widths but where it is negligible. Floats, [pixel][channel].
inline constexpr const char* kThermalLayer = "thermal_half_width";
sampling::TileLayer empty_thermal_layer(std::size_t channels, const sampling::TileResult& tile);
void add_thermal_layer(std::span<const NodeHalfWidth> nodes, sampling::TileResult& tile);

/// Widens a tile's intervals by what the nodes may be wrong by wherever that is more than NodeHalfWidth::kNegligible of
/// what was asked for (everywhere, where nothing was), and judges those pixels anew. `tolerance` may be null.
void widen(std::span<const NodeHalfWidth> nodes, const AccuracyTolerance* tolerance,
           sampling::TileResult& tile);

}  // namespace ifov::render
