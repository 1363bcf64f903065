#pragma once

#include <span>
#include <string>
#include <vector>

namespace ifov::atmosphere {
class AtmosphereColumn;
struct SensorGeometry;
}  // namespace ifov::atmosphere
namespace ifov::io {
struct ModelledAtmosphere;
}
namespace ifov::radiometry {
struct Channel;
}
namespace ifov::scene {
struct Scene;
}

namespace ifov::session {

/// Air, gases, haze, clouds and geometry in words, a line each.
std::vector<std::string> atmosphere_statement(const atmosphere::AtmosphereColumn& column,
                                              const atmosphere::SensorGeometry& geometry,
                                              const scene::Scene& scene,
                                              const io::ModelledAtmosphere& written,
                                              std::span<const radiometry::Channel> channels);

}  // namespace ifov::session
