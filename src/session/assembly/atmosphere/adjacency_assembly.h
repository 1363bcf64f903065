#pragma once

#include <memory>
#include <string>

#include "session/assembly/atmosphere/atmosphere_subject.h"

namespace ifov::atmosphere {
class SensorAtmosphere;
}
namespace ifov::io {
struct ModelledAtmosphere;
struct OriginDocument;
}  // namespace ifov::io
namespace ifov::transport {
class AdjacentGround;
class SpectralScene;
}  // namespace ifov::transport

namespace ifov::session {

/// The scene's own ground as the air spreads it, and one line that says what was done.
struct AssembledAdjacency {
  std::shared_ptr<const transport::AdjacentGround>
      ground;  ///< null: the surroundings are all that lights the air
  std::string statement;
};
AssembledAdjacency assemble_adjacency(const io::ModelledAtmosphere& written, const io::OriginDocument& origin,
                                      const AtmosphereSubject& subject,
                                      const atmosphere::SensorAtmosphere& air,
                                      const transport::SpectralScene& lit, int threads);

}  // namespace ifov::session
