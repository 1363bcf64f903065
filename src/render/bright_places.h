#pragma once

#include <span>

#include "math/vec3.h"
#include "render/wings/wing_spots.h"
#include "sampling/image/bright_places.h"

namespace ifov::render {

/// Where small things that outshine the scene stand in the image: parts of surfaces (transport::ShiningParts) that look smaller than a
/// pixel, what mirrors and maps show of such (`others`), and the Sun's disc of half that angle in the directions in which the sensor would
/// see it (`glare`). Of what moves, where it stands at the document's time.
sampling::BrightPlaces bright_places(const transport::SpectralScene& scene, const sensor::Camera& camera,
                                     std::span<const WingSpots::Box> others,
                                     std::span<const math::Vec3> glare, double half_angle_rad);

}  // namespace ifov::render
