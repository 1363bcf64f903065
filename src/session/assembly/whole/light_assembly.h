#pragma once

#include <optional>

#include "geodesy/utc_time.h"
#include "materials/material.h"

namespace ifov::io {
struct AtmosphereDocument;
struct DocumentSources;
struct LightDocument;
struct OriginDocument;
}  // namespace ifov::io
namespace ifov::scene {
struct Scene;
}

namespace ifov::session {

/// What of a document tells how its scene is lit: beside the light itself the air, which may know what of it comes through,
/// and where and when the scene is, which is where the Sun and the Moon stand.
struct LightParts {
  const io::DocumentSources& sources;
  const io::LightDocument& light;
  const io::AtmosphereDocument& atmosphere;
  const io::OriginDocument& origin;
  const std::optional<geodesy::UtcTime>& time;
  std::optional<materials::Material> ground;  ///< of the surroundings, where they are named as a material
};

/// Sun or Moon, sky, surroundings and the view path of a document, into the scene (whose materials gain the
/// surroundings').
void assemble_light(const LightParts& parts, scene::Scene& scene);

}  // namespace ifov::session
