#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "math/vec3.h"
#include "radiometry/channel.h"

namespace ifov::geometry {
class World;
}
namespace ifov::io {
struct CameraDocument;
struct ChannelDocument;
struct DocumentSources;
struct OriginDocument;
struct SensorDocument;
}  // namespace ifov::io
namespace ifov::render {
struct ImageInfo;
struct Polarimetry;
}  // namespace ifov::render
namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}  // namespace ifov::sensor

namespace ifov::session {

/// A camera stands about the scene's origin; `world` tells where rays of a nadir camera without a height start.
std::unique_ptr<sensor::Camera> assemble_camera(const io::DocumentSources& sources,
                                                const io::CameraDocument& camera,
                                                const io::OriginDocument& origin,
                                                const geometry::World& world, std::uint64_t seed);
std::vector<radiometry::Channel> assemble_channels(const io::DocumentSources& sources,
                                                   std::span<const io::ChannelDocument> written);
/// Whether polarization is told, and what stands before the channels.
std::shared_ptr<const render::Polarimetry> assemble_polarimetry(const io::SensorDocument& sensor);
/// Names, channels and map information for products; `map_offset_m` as of MapFrame.
render::ImageInfo image_info(const io::OriginDocument& origin, const sensor::Camera& camera,
                             const std::vector<radiometry::Channel>& channels, const scene::Scene& scene,
                             math::Vec3 map_offset_m);

}  // namespace ifov::session
