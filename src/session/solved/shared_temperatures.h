#pragma once

#include <memory>
#include <span>

#include "scene/temperature_scope.h"

namespace ifov::session {

struct Parts;

/// The solved temperatures of one document, loaded at several times, to be asked together; null where they cannot be, as
/// exposure::SurfacesOfTimes::of. Keeps references to the scenes.
std::unique_ptr<const scene::TemperaturesOfTimes> share_temperatures(std::span<const Parts* const> by_time);

}  // namespace ifov::session
