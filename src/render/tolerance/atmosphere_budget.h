#pragma once

#include <span>
#include <vector>

#include "render/tolerance/atmosphere_half_width.h"

namespace ifov::sampling {
struct TileResult;
}
namespace ifov::atmosphere {
class SensorAtmosphere;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

class AccuracyTolerance;
struct Polarimetry;

/// By channel; empty where the atmosphere does not know its errors.
std::vector<AtmosphereHalfWidth> atmosphere_half_widths(const transport::SpectralScene& scene,
                                                        const atmosphere::SensorAtmosphere& atmosphere);

/// Tells them what stands before the channels.
void pass_optics(const Polarimetry& polarimetry, std::span<AtmosphereHalfWidth> air);

/// Adds what the air may be wrong by to a tile's bounds, and judges its pixels anew by what was asked for. Such an error is
/// the same in all pixels and for all rays: it neither averages out nor is it independent of anything.
/// `tolerance` may be null.
void widen(std::span<const AtmosphereHalfWidth> air, const AccuracyTolerance* tolerance,
           sampling::TileResult& tile);

}  // namespace ifov::render
