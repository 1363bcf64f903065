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
struct AiryPsf;
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
class Psf;
struct AiryAperture;
struct Pupil;
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
/// What a PSF of diffraction says of its aperture; nothing where it is another.
std::optional<io::AiryPsf> diffraction_of(const io::SensorDocument& sensor);
/// Of a PSF of a pupil, at a wavelength where it states none.
sensor::Pupil assemble_pupil(const io::SensorDocument& sensor, double wavelength_um);
/// Diffraction as an Airy PSF has it, in lengths whose ratios are right; the wavelength 0 where it is each channel's own.
sensor::AiryAperture airy_aperture(const io::SensorDocument& sensor);
/// At a wavelength, where the document says none; null without one: perfect optics. `contrast`: how many times as bright as the rest the
/// brightest is.
std::unique_ptr<sensor::Psf> assemble_psf(const io::DocumentSources& sources,
                                          const io::SensorDocument& sensor, double wavelength_um,
                                          double contrast);

/// Names, channels and map information for products; `map_offset_m` as of MapFrame.
render::ImageInfo image_info(const io::OriginDocument& origin, const sensor::Camera& camera,
                             const std::vector<radiometry::Channel>& channels, const scene::Scene& scene,
                             math::Vec3 map_offset_m);

}  // namespace ifov::session
