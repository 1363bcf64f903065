#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "math/vec3.h"
#include "sampling/field.h"

namespace ifov::geometry {
struct SurfacePoint;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::render {

/// Fixed points of the Sun's rim from which a surface is seen or not, where the Sun has a disc.
inline constexpr std::size_t kRimPoints = 3;

/// Shadows whose things hide more of the Sun's disc than this are told by the fixed points of its rim, and by first values.
inline constexpr double kThinShare = 0.3;

/// Calls `visit` with places in the shadow of a part of something that looks `width_m` wide from the Sun, and the share of
/// the Sun's disc that is hidden there at most, where that is small. `away`: rays from the part away from the fixed points of the rim;
/// `arrived`: what they met; `number`: of the part, which turns the places.
void visit_thin_shadow(std::span<const math::Ray, kRimPoints> away,
                       std::span<const geometry::SurfacePoint, kRimPoints> arrived, double width_m,
                       std::size_t number, const sensor::Camera& camera,
                       const std::function<void(sampling::FocalPoint, float share)>& visit);

}  // namespace ifov::render
