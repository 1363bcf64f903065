#include "render/small_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/world.h"
#include "sensor/camera.h"

namespace ifov::render {

namespace {

constexpr std::size_t kMostPieces = std::size_t{1} << 20;
/// Pieces that are gone through for a few: of materials that have few, or that outshine the scene.
constexpr std::size_t kMostCounted = std::size_t{1} << 24;
/// What is wider than this meets the detection lattice anyway.
constexpr double kNarrow_px = 1.0;
/// Points of a long piece are this far apart.
constexpr double kPointsApart_px = 0.35;
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
    if (++count > kMostCounted) return;
    const UnitShape shape = unit_shape(piece.kind);
    sampling::FocalPoint middle;
    if (!camera.project(piece.scene_from_unit(math::Point3{} + shape.middle), middle)) return;
    const Extent extent = extent_of(piece, shape, camera, middle);
    if (2.0 * extent.half_width_px > kNarrow_px) return;
    if (2.0 * extent.half_length_px <= kPointsApart_px) return add(middle);
    const double parts = std::min(std::ceil(2.0 * extent.half_length_px / kPointsApart_px), kMostPointsOfOne);
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

namespace {

constexpr double kApartPatches_px = 0.5;

/// A place of kApartPatches_px each way.
struct Place {
  std::int64_t x = 0, y = 0;
  auto operator<=>(const Place&) const = default;
};
std::optional<Place> place_of(sampling::FocalPoint p) {
  if (!(std::abs(p.x_px) < 1e9) || !(std::abs(p.y_px) < 1e9)) return {};
  return Place{static_cast<std::int64_t>(std::floor(p.x_px / kApartPatches_px)),
               static_cast<std::int64_t>(std::floor(p.y_px / kApartPatches_px))};
}

/// Bounds in the image.
struct Bounds {
  sampling::FocalPoint low, high;
  void add(sampling::FocalPoint p) {
    low = {std::min(low.x_px, p.x_px), std::min(low.y_px, p.y_px)};
    high = {std::max(high.x_px, p.x_px), std::max(high.y_px, p.y_px)};
  }
  bool small() const { return high.x_px - low.x_px <= kNarrow_px && high.y_px - low.y_px <= kNarrow_px; }
};

/// A piece smaller than a pixel.
struct SmallPiece {
  std::uint32_t object = 0, material = 0;
  sampling::FocalPoint middle;
};

/// Calls `at` with a piece of each place where it or a place about it holds pieces of another material of the object:
/// single faces of a mesh that are painted otherwise, and where paints meet.
/// `large`: materials of larger pieces of objects, (object, material), which may lie where no small piece does.
void visit_islands(std::vector<SmallPiece> pieces, const std::set<std::uint32_t>& painted,
                   const std::set<std::pair<std::uint32_t, std::uint32_t>>& large,
                   const std::function<void(const SmallPiece&)>& at) {
  std::erase_if(pieces,
                [&](const SmallPiece& p) { return !painted.contains(p.object) || !place_of(p.middle); });
  using Key = std::tuple<std::uint32_t, Place, std::uint32_t>;
  const auto key_of = [](const SmallPiece& p) { return Key{p.object, *place_of(p.middle), p.material}; };
  std::stable_sort(pieces.begin(), pieces.end(),
                   [&](const SmallPiece& a, const SmallPiece& b) { return key_of(a) < key_of(b); });
  std::vector<Key> keys(pieces.size());
  std::transform(pieces.begin(), pieces.end(), keys.begin(), key_of);
  const auto larger_of_another = [&](std::uint32_t object, std::uint32_t material) {
    const auto first = large.lower_bound({object, 0u}), last = large.upper_bound({object, ~0u});
    return first != last && (first->second != material || std::prev(last)->second != material);
  };
  // Whether a place holds no other material of this object.
  const auto only = [&](std::uint32_t object, Place place, std::uint32_t material) {
    const auto first = std::lower_bound(keys.begin(), keys.end(), Key{object, place, 0u});
    const auto last = std::upper_bound(first, keys.end(), Key{object, place, ~0u});
    if (first == last) return !larger_of_another(object, material);
    return std::get<2>(*first) == material && std::get<2>(*std::prev(last)) == material;
  };
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (k > 0 && keys[k] == keys[k - 1]) continue;
    const auto& [object, place, material] = keys[k];
    bool alike = true;
    for (std::int64_t dy = -1; alike && dy <= 1; ++dy)
      for (std::int64_t dx = -1; alike && dx <= 1; ++dx)
        alike = only(object, {place.x + dx, place.y + dy}, material);
    if (!alike) at(pieces[k]);
  }
}

}  // namespace

geometry::WantedMaterials rare_materials(const geometry::World& world, std::size_t materials) {
  if (world.triangle_count() <= kMostPieces && world.object_count() <= kMostPieces)
    return geometry::WantedMaterials(materials, true);
  geometry::WantedMaterials rare(materials, false);
  if (world.triangle_count() > kMostCounted || world.object_count() > kMostCounted) return rare;
  std::vector<std::pair<std::size_t, std::size_t>> pieces(materials);  // and of which material
  for (std::size_t m = 0; m < materials; ++m) pieces[m].second = m;
  world.visit_surfaces(geometry::WantedMaterials(materials, true),
                       [&](const geometry::SurfacePiece& piece) { ++pieces[piece.material].first; });
  std::sort(pieces.begin(), pieces.end());
  std::size_t sum = 0;
  for (const auto& [count, material] : pieces) {
    sum += count;
    if (sum > kMostPieces) break;
    rare[material] = true;
  }
  return rare;
}

void visit_small_patches(const geometry::World& world, std::size_t materials,
                         const std::function<bool(std::uint32_t)>& wanted, const sensor::Camera& camera,
                         const std::function<void(sampling::FocalPoint)>& at) {
  const geometry::WantedMaterials looked_at = rare_materials(world, materials);
  if (std::find(looked_at.begin(), looked_at.end(), true) == looked_at.end()) return;
  struct Patch {
    Bounds bounds;
    sampling::FocalPoint middle;
  };
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, Patch> patches;
  std::vector<SmallPiece> small;
  std::map<std::uint32_t, std::uint32_t> first_material;  // by object
  std::set<std::uint32_t> painted;                        // objects of several materials
  std::set<std::pair<std::uint32_t, std::uint32_t>> large;
  world.visit_surfaces(looked_at, [&](const geometry::SurfacePiece& piece) {
    if (!wanted(piece.object)) return;
    const UnitShape shape = unit_shape(piece.kind);
    sampling::FocalPoint middle;
    if (!camera.project(piece.scene_from_unit(math::Point3{} + shape.middle), middle)) return;
    if (patches.size() > kMostPieces) return;
    Bounds bounds{middle, middle};
    for (const math::Vec3& side : {math::Vec3{shape.reach.x, 0.0, 0.0}, math::Vec3{0.0, shape.reach.y, 0.0},
                                   math::Vec3{0.0, 0.0, shape.reach.z}})
      for (const double sign : {-1.0, 1.0}) {
        sampling::FocalPoint end;
        if (camera.project(piece.scene_from_unit(math::Point3{} + shape.middle + sign * side), end))
          bounds.add(end);
      }
    const auto [known, fresh] =
        patches.try_emplace({piece.object, piece.patch, piece.material}, Patch{bounds, middle});
    known->second.bounds.add(bounds.low);
    known->second.bounds.add(bounds.high);
    if (first_material.try_emplace(piece.object, piece.material).first->second != piece.material)
      painted.insert(piece.object);
    if (bounds.small())
      small.push_back({piece.object, piece.material, middle});
    else
      large.emplace(piece.object, piece.material);
  });
  std::set<std::pair<std::uint32_t, Place>> known;
  const auto add = [&](std::uint32_t material, sampling::FocalPoint middle) {
    const std::optional<Place> place = place_of(middle);
    if (place && known.emplace(material, *place).second) at(middle);
  };
  for (const auto& [key, patch] : patches)
    if (patch.bounds.small()) add(std::get<2>(key), patch.middle);
  visit_islands(std::move(small), painted, large,
                [&](const SmallPiece& piece) { add(piece.material, piece.middle); });
}

}  // namespace ifov::render
