#include "transport/shining_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world.h"
#include "scene/scene.h"
#include "transport/emitter_choice.h"
#include "transport/shapes/emitter_shape.h"
#include "transport/spectral_scene.h"

namespace ifov::transport {

using geometry::PieceKind;
using geometry::SurfacePiece;
using math::Point3;
using math::Vec3;

namespace {

/// A part is not divided further that fills so much of its ball's disc: a closed surface four times it is.
constexpr double kFilled = 0.5;
constexpr double kLeastFill = 1.0 / 64.0;
/// Pieces so many times as long as wide are cut across.
constexpr double kLong = 4.0;
constexpr double kMostCuts = 256.0;

double disc_m2(double radius_m) { return std::numbers::pi * radius_m * radius_m; }

geometry::SurfaceSurvey::Ball about(std::span<const geometry::SurfaceSurvey::Ball* const> balls) {
  Point3 low = balls[0]->centre_m, high = low;
  for (const auto* ball : balls) {
    const Point3 c = ball->centre_m;
    const double r = ball->radius_m;
    low = {std::min(low.x, c.x - r), std::min(low.y, c.y - r), std::min(low.z, c.z - r)};
    high = {std::max(high.x, c.x + r), std::max(high.y, c.y + r), std::max(high.z, c.z + r)};
  }
  geometry::SurfaceSurvey::Ball all{low + (high - low) * 0.5, 0.0};
  for (const auto* ball : balls)
    all.radius_m = std::max(all.radius_m, length(ball->centre_m - all.centre_m) + ball->radius_m);
  return all;
}

}  // namespace

ShiningParts::ShiningParts(const SpectralScene& scene) {
  const EmitterChoice choice(scene, EmitterChoice::InMirrors{kContrast});
  if (!choice.any()) return;
  wanted_ = choice.wanted();
  usual_ = choice.usual();
  for (std::uint32_t c = 0; c < wanted_.size(); ++c)
    highest_.push_back(wanted_[c] ? choice.highest(c) : std::vector<double>());
  const geometry::World& world = *scene.scene().world;
  std::size_t count = 0;
  world.visit_surfaces(wanted_, [&](const SurfacePiece&) { ++count; });
  if (count > kMost) {
    complete_ = false;
    return;
  }
  std::vector<SurfacePiece> found;
  found.reserve(count);
  world.visit_surfaces(wanted_, [&](const SurfacePiece& piece) {
    if (geometry::area_m2(piece) > 0.0) found.push_back(piece);
  });
  std::stable_sort(found.begin(), found.end(),
                   [](const SurfacePiece& a, const SurfacePiece& b) { return a.object < b.object; });
  std::vector<Piece> pieces;
  for (std::size_t first = 0; first < found.size();) {
    const std::uint32_t object = found[first].object;
    Part part;
    part.object = object;
    std::size_t last = first;
    for (; last < found.size() && found[last].object == object; ++last)
      if (const double contrast = choice.contrast(found[last].material); contrast > part.contrast)
        part.contrast = contrast, part.assignment = found[last].material;
    pieces.clear();
    for (; first < last; ++first) {
      const SurfacePiece& piece = found[first];
      const EmitterShape shape(piece, false);
      entries_.push_back({{piece.object, piece.primitive, piece.patch}, 0, 1, {}, {}});
      const double area = geometry::area_m2(piece);
      if (area < disc_m2(shape.radius_m()) / kLong)
        cut(piece, part);
      else
        pieces.push_back({{shape.centre_m(), shape.radius_m()}, area, entries_.size() - 1});
    }
    put_together(pieces, part);
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
}

/// Of the piece whose entry is the last.
void ShiningParts::cut(const SurfacePiece& piece, Part part) {
  const math::Transform& map = piece.scene_from_unit;
  // The box of the unit shape, and its longest side in the scene.
  const bool flat = piece.kind == PieceKind::triangle || piece.kind == PieceKind::parallelogram;
  Point3 low{-1.0, -1.0, -1.0};
  Vec3 side[3] = {map(Vec3{2.0, 0.0, 0.0}), map(Vec3{0.0, 2.0, 0.0}), map(Vec3{0.0, 0.0, 2.0})};
  if (flat) {
    low = {};
    for (Vec3& s : side) s = 0.5 * s;
    side[2] = {};
  } else if (piece.kind == PieceKind::disk) {
    low.z = 0.0, side[2] = {};
  } else if (piece.kind == PieceKind::open_cylinder || piece.kind == PieceKind::hemisphere) {
    low.z = 0.0, side[2] = 0.5 * side[2];
  }
  // A triangle as thin as that is as long as its longest edge, which may be the third.
  const Point3 origin = map(low);
  const Vec3 third = side[1] - side[0];
  Vec3 longest = side[0];
  for (const Vec3& s : side)
    if (length(s) > length(longest)) longest = s;
  if (piece.kind == PieceKind::triangle && length(third) > length(longest)) longest = third;
  const Vec3 axis = longest / length(longest);
  double from = 0.0, to = 0.0;
  double across = 0.0;
  for (const Vec3& s : side) {
    const double along = dot(s, axis);
    (along < 0.0 ? from : to) += along;
    across += length(s - along * axis);
  }
  const double span = to - from;
  const double parts = std::clamp(std::ceil(span / std::max(across, 1e-300)), 1.0, kMostCuts);
  Entry& entry = entries_.back();
  entry.part = static_cast<std::uint32_t>(parts_.size());
  entry.count = static_cast<std::uint32_t>(parts);
  entry.from = origin + axis * from;
  entry.axis = axis * (parts / span);
  const Vec3 middle = 0.5 * (side[0] + side[1] + side[2]);
  const Vec3 off = middle - dot(middle, axis) * axis;
  const double radius = std::hypot(0.5 * span / parts, 0.5 * across);
  part.ball.radius_m = radius;
  part.fill = std::clamp(geometry::area_m2(piece) / parts / disc_m2(radius), kLeastFill, 1.0);
  for (std::uint32_t k = 0; k < entry.count; ++k) {
    part.ball.centre_m = origin + off + axis * (from + span * (k + 0.5) / parts);
    parts_.push_back(part);
  }
}

void ShiningParts::put_together(std::span<Piece> pieces, Part part) {
  if (pieces.empty()) return;
  std::vector<const geometry::SurfaceSurvey::Ball*> balls;
  double area = 0.0;
  for (const Piece& piece : pieces) balls.push_back(&piece.ball), area += piece.area_m2;
  const geometry::SurfaceSurvey::Ball ball = about(balls);
  const double fill = area / disc_m2(ball.radius_m);
  if (pieces.size() == 1 || fill >= kFilled) {
    for (const Piece& piece : pieces) entries_[piece.entry].part = static_cast<std::uint32_t>(parts_.size());
    part.ball = ball;
    part.fill = std::clamp(fill, kLeastFill, 1.0);
    parts_.push_back(part);
    return;
  }
  const auto at = [](const Piece& piece, int axis) {
    const Point3 c = piece.ball.centre_m;
    return axis == 0 ? c.x : axis == 1 ? c.y : c.z;
  };
  int longest = 0;
  double side = -1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax_element(pieces.begin(), pieces.end(),
                            [&](const Piece& a, const Piece& b) { return at(a, axis) < at(b, axis); });
    if (at(*high, axis) - at(*low, axis) > side) side = at(*high, axis) - at(*low, axis), longest = axis;
  }
  const std::size_t half = pieces.size() / 2;
  std::nth_element(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(half), pieces.end(),
                   [&](const Piece& a, const Piece& b) { return at(a, longest) < at(b, longest); });
  put_together(pieces.first(half), part);
  put_together(pieces.subspan(half), part);
}

std::uint32_t ShiningParts::part_of(const geometry::SurfacePoint& hit) const {
  const Name name{hit.instance, hit.primitive, hit.patch};
  const auto found = std::lower_bound(entries_.begin(), entries_.end(), name,
                                      [](const Entry& entry, const Name& n) { return entry.name < n; });
  if (found == entries_.end() || found->name != name) return kNone;
  const double number = std::floor(dot(found->axis, hit.position_m - found->from));
  return found->part + static_cast<std::uint32_t>(std::clamp(number, 0.0, found->count - 1.0));
}

}  // namespace ifov::transport
