#pragma once

#include <memory>
#include <vector>

#include "math/vec3.h"
#include "radiometry/channel.h"

namespace ifov::io {
struct Document;
}
namespace ifov::render {
struct ImageInfo;
struct Polarimetry;
}  // namespace ifov::render
namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
class Psf;
}  // namespace ifov::sensor

namespace ifov::session {

/// `scene` tells where rays of a nadir camera without a height start.
std::unique_ptr<sensor::Camera> assemble_camera(const io::Document& document, const scene::Scene& scene);
std::vector<radiometry::Channel> assemble_channels(const io::Document& document);
/// Whether polarization is told, and what stands before the channels.
render::Polarimetry assemble_polarimetry(const io::Document& document);
/// Null without one: perfect optics.
std::unique_ptr<sensor::Psf> assemble_psf(const io::Document& document);

/// Names, channels and map information for products; `map_offset_m` as of MapFrame.
render::ImageInfo image_info(const io::Document& document, const sensor::Camera& camera,
                             const std::vector<radiometry::Channel>& channels, const scene::Scene& scene,
                             math::Vec3 map_offset_m);

}  // namespace ifov::session
