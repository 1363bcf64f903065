#pragma once

#include <memory>
#include <span>

#include "scene/temperature_scope.h"

namespace ifov::scene {
struct Scene;
}

namespace ifov::exposure {

/// SurfacesOfTimes::of.
std::unique_ptr<const scene::TemperaturesOfTimes> share_surfaces(
    std::span<const scene::Scene* const> by_time);

}  // namespace ifov::exposure
