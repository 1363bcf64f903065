#include "render/small_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "geometry/world.h"
#include "sensor/camera.h"

namespace ifov::render {

namespace {

constexpr std::size_t kMostPieces = std::size_t{1} << 20;
/// What is wider than this meets the detection lattice anyway.
constexpr double kNarrow_px = 1.0;
/// Points of a long piece are this far apart.
constexpr double kSpacing_px = 0.35;
constexpr double kMostPointsOfOne = 1e5;
/// Of pieces nearer to each other than this one is enough.
constexpr double kApart_px = 0.25;

/// The middle of a unit shape, and how far it reaches from there along its axes.
struct UnitShape {
  math::Vec3 middle, reach;
};
UnitShape unit_shape(geometry::PieceKind kind) {
  switch (kind) {
    case geometry::PieceKind::triangle: return {{1.0 / 3.0, 1.0 / 3.0, 0.0}, {0.5, 0.5, 0.0}};
    case geometry::PieceKind::parallelogram: return {{0.5, 0.5, 0.0}, {0.5, 0.5, 0.0}};
    case geometry::PieceKind::disk: return {{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}};
    case geometry::PieceKind::open_cylinder: return {{0.0, 0.0, 0.5}, {1.0, 1.0, 0.5}};
    case geometry::PieceKind::ball: return {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
    case geometry::PieceKind::hemisphere: return {{0.0, 0.0, 0.5}, {1.0, 1.0, 0.5}};
  }
  return {};
}

/// Half of a piece's longest side in the image, and the half width across it, px.
struct Extent {
  math::Vec3 along;  // in the unit shape, from its middle to the end
  double half_length_px = 0.0, half_width_px = 0.0;
};
Extent extent_of(const geometry::SurfacePiece& piece, const UnitShape& shape, const sensor::Camera& camera,
                 sampling::FocalPoint middle) {
  const std::array<math::Vec3, 3> sides{math::Vec3{shape.reach.x, 0.0, 0.0},
                                        math::Vec3{0.0, shape.reach.y, 0.0},
                                        math::Vec3{0.0, 0.0, shape.reach.z}};
  std::array<std::array<double, 2>, 3> seen{};
  Extent extent;
  std::size_t longest = 0;
  for (std::size_t s = 0; s < 3; ++s) {
    sampling::FocalPoint end;
    if (!camera.project(piece.scene_from_unit(math::Point3{} + shape.middle + sides[s]), end)) continue;
    seen[s] = {end.x_px - middle.x_px, end.y_px - middle.y_px};
    const double length = std::hypot(seen[s][0], seen[s][1]);
    if (length > extent.half_length_px) extent.half_length_px = length, longest = s;
  }
  extent.along = sides[longest];
  if (extent.half_length_px > 0.0)
    for (const auto& side : seen)
      extent.half_width_px +=
          std::abs(side[0] * seen[longest][1] - side[1] * seen[longest][0]) / extent.half_length_px;
  return extent;
}

}  // namespace

void visit_pixel_between(sampling::FocalPoint from, sampling::FocalPoint to,
                         const std::function<void(sampling::FocalPoint, double share)>& at) {
  const double x = std::max(std::floor(from.x_px), std::floor(to.x_px)),
               y = std::max(std::floor(from.y_px), std::floor(to.y_px));
  if (std::floor(from.x_px) == std::floor(to.x_px) || std::floor(from.y_px) == std::floor(to.y_px)) return;
  // It leaves the column at one place and the row at another; in between it is in a third pixel.
  const double share =
      0.5 * ((x - from.x_px) / (to.x_px - from.x_px) + (y - from.y_px) / (to.y_px - from.y_px));
  at({from.x_px + share * (to.x_px - from.x_px), from.y_px + share * (to.y_px - from.y_px)}, share);
}

void visit_small_pieces(const geometry::World& world, const geometry::WantedMaterials& wanted,
                        const sensor::Camera& camera, const std::function<void(sampling::FocalPoint)>& at) {
  if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) return;
  std::set<std::pair<std::int64_t, std::int64_t>> known;
  std::size_t count = 0;
  const auto add = [&](sampling::FocalPoint point) {
    if (!(std::abs(point.x_px) < 1e9) || !(std::abs(point.y_px) < 1e9)) return;
    if (known
            .emplace(static_cast<std::int64_t>(std::floor(point.x_px / kApart_px)),
                     static_cast<std::int64_t>(std::floor(point.y_px / kApart_px)))
            .second)
      at(point);
  };
  world.visit_surfaces(wanted, [&](const geometry::SurfacePiece& piece) {
    if (++count > kMostPieces) return;
    const UnitShape shape = unit_shape(piece.kind);
    sampling::FocalPoint middle;
    if (!camera.project(piece.scene_from_unit(math::Point3{} + shape.middle), middle)) return;
    const Extent extent = extent_of(piece, shape, camera, middle);
    if (2.0 * extent.half_width_px > kNarrow_px) return;
    if (2.0 * extent.half_length_px <= kSpacing_px) return add(middle);
    const double parts = std::min(std::ceil(2.0 * extent.half_length_px / kSpacing_px), kMostPointsOfOne);
    sampling::FocalPoint last, next;
    bool any = false;
    for (double k = 0.0; k < parts; k += 1.0) {
      const double t = (2.0 * k + 1.0) / parts - 1.0;
      if (!camera.project(piece.scene_from_unit(math::Point3{} + shape.middle + t * extent.along), next)) {
        any = false;
        continue;
      }
      if (any) visit_pixel_between(last, next, [&](sampling::FocalPoint between, double) { at(between); });
      add(next);
      last = next;
      any = true;
    }
  });
}

void visit_small_patches(const geometry::World& world, std::size_t materials,
                         const std::function<bool(std::uint32_t)>& wanted, const sensor::Camera& camera,
                         const std::function<void(sampling::FocalPoint)>& at) {
  constexpr double kApartPatches_px = 0.5;
  if (world.triangle_count() > kMostPieces || world.object_count() > kMostPieces) return;
  struct Patch {
    sampling::FocalPoint low, high, middle;
  };
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, Patch> patches;
  world.visit_surfaces(geometry::WantedMaterials(materials, true), [&](const geometry::SurfacePiece& piece) {
    if (!wanted(piece.object)) return;
    const UnitShape shape = unit_shape(piece.kind);
    sampling::FocalPoint middle;
    if (!camera.project(piece.scene_from_unit(math::Point3{} + shape.middle), middle)) return;
    if (patches.size() > kMostPieces) return;
    const auto [known, fresh] =
        patches.try_emplace({piece.object, piece.patch, piece.material}, Patch{middle, middle, middle});
    Patch& patch = known->second;
    for (const math::Vec3& side : {math::Vec3{shape.reach.x, 0.0, 0.0}, math::Vec3{0.0, shape.reach.y, 0.0},
                                   math::Vec3{0.0, 0.0, shape.reach.z}})
      for (const double sign : {-1.0, 1.0}) {
        sampling::FocalPoint end;
        if (!camera.project(piece.scene_from_unit(math::Point3{} + shape.middle + sign * side), end))
          continue;
        patch.low = {std::min(patch.low.x_px, end.x_px), std::min(patch.low.y_px, end.y_px)};
        patch.high = {std::max(patch.high.x_px, end.x_px), std::max(patch.high.y_px, end.y_px)};
      }
  });
  std::set<std::tuple<std::uint32_t, std::int64_t, std::int64_t>> known;
  for (const auto& [key, patch] : patches) {
    if (patch.high.x_px - patch.low.x_px > kNarrow_px || patch.high.y_px - patch.low.y_px > kNarrow_px)
      continue;
    const sampling::FocalPoint p = patch.middle;
    if (!(std::abs(p.x_px) < 1e9) || !(std::abs(p.y_px) < 1e9)) continue;
    if (known
            .emplace(std::get<2>(key), static_cast<std::int64_t>(std::floor(p.x_px / kApartPatches_px)),
                     static_cast<std::int64_t>(std::floor(p.y_px / kApartPatches_px)))
            .second)
      at(p);
  }
}

}  // namespace ifov::render
