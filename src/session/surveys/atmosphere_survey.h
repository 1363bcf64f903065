#pragma once

#include "ifov/atmosphere.h"
#include "io/atmosphere_report/atmosphere_report.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// Answers without reading the scene's meshes and maps. Throws InputError where the document has no modelled
/// atmosphere, or names no such channel, and what Session::load does for atmosphere, light and sensor.
io::AtmosphereReport survey_atmosphere(const io::Document& document, const AtmosphereQuestion& question);

}  // namespace ifov::session
