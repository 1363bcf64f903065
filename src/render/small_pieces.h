#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "geometry/surface_piece.h"
#include "sampling/field.h"

namespace ifov::geometry {
class World;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::render {

/// Calls `at` with points in the image of pieces of wanted surfaces, of copies too, that are narrower than a pixel; of longer ones all
/// along them. Of many in a quarter of a pixel, with one; after 2^24 pieces no more.
void visit_small_pieces(const geometry::World& world, const geometry::WantedMaterials& wanted,
                        const sensor::Camera& camera, const std::function<void(sampling::FocalPoint)>& at);

/// Surface assignments whose small parts are looked for one by one: all, or in a scene of more than 2^20 triangles, copies counted, or
/// objects, those that have the fewest pieces, 2^20 together; none beyond 2^24.
geometry::WantedMaterials rare_materials(const geometry::World& world, std::size_t materials);

/// Calls `at` with points in the image of smooth patches of objects (SurfacePoint::patch) that are smaller than a pixel: small parts of
/// copies and of meshes; and of pieces smaller than a pixel beside those of another material of the same object: faces that are painted
/// otherwise. Of many of one material in half a pixel, with one; of rare_materials() alone.
/// `wanted`: of an object.
void visit_small_patches(const geometry::World& world, std::size_t materials,
                         const std::function<bool(std::uint32_t)>& wanted, const sensor::Camera& camera,
                         const std::function<void(sampling::FocalPoint)>& at);

/// Calls `at` with a point of the image in the pixel that a straight line passes through between two points of it less than a pixel
/// apart, where neither is in that pixel.
void visit_pixel_between(sampling::FocalPoint from, sampling::FocalPoint to,
                         const std::function<void(sampling::FocalPoint, double share)>& at);

}  // namespace ifov::render
