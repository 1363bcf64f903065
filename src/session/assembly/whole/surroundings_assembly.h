#pragma once

#include <optional>
#include <string>

namespace ifov::io {
struct AtmosphereDocument;
struct LightDocument;
}  // namespace ifov::io
namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::session {

/// Under an atmosphere ground and air exchange light, and black surroundings would take up to a third of it away. Where
/// the document declares none, the surroundings become the mean of the ground in the picture: rays straight down at the
/// places that a grid of the camera's rays meets, reflectances weighed by area, the mean temperature of what emits
/// (only if more than half of it does). Returns one line that says so; nothing where surroundings are declared, where
/// no atmosphere is modelled or imported, or where the camera meets nothing.
std::optional<std::string> assume_surroundings(const io::LightDocument& light,
                                               const io::AtmosphereDocument& atmosphere,
                                               const sensor::Camera& camera, scene::Scene& scene);

}  // namespace ifov::session
