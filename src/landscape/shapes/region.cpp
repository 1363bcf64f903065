#include "landscape/shapes/region.h"

#include <algorithm>
#include <polyclipping/clipper.hpp>

namespace ifov::landscape {
namespace {

using ClipperLib::Path;
using ClipperLib::Paths;

constexpr double kUnits_per_m = 1e4;
constexpr double kArcTolerance_units = 20.0;  // rounded corners keep within 2 mm of the circle

Region::Corner on_grid(Vec2 p) {
  return {static_cast<std::int64_t>(std::llround(p.x * kUnits_per_m)),
          static_cast<std::int64_t>(std::llround(p.y * kUnits_per_m))};
}
Vec2 in_metres(Region::Corner c) {
  return {static_cast<double>(c.x) / kUnits_per_m, static_cast<double>(c.y) / kUnits_per_m};
}

Path path_of(const Region::Ring& ring) {
  Path path;
  for (const Region::Corner& c : ring) path.emplace_back(c.x, c.y);
  return path;
}
Paths paths_of(const std::vector<Region::Ring>& rings) {
  Paths paths;
  for (const Region::Ring& ring : rings) paths.push_back(path_of(ring));
  return paths;
}
Region::Ring ring_of(const Path& path) {
  Region::Ring ring;
  for (const ClipperLib::IntPoint& p : path) ring.push_back({p.X, p.Y});
  return ring;
}
std::vector<Region::Ring> rings_of(const Paths& paths) {
  std::vector<Region::Ring> rings;
  for (const Path& path : paths) rings.push_back(ring_of(path));
  return rings;
}

Paths combined(ClipperLib::ClipType type, const Paths& subject, const Paths& clip) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(subject, ClipperLib::ptSubject, true);
  clipper.AddPaths(clip, ClipperLib::ptClip, true);
  Paths result;
  clipper.Execute(type, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  ClipperLib::CleanPolygons(result, 2.0);
  std::erase_if(result, [](const Path& path) { return path.size() < 3; });
  return result;
}

std::vector<Point3> raised(const Path& path, const Region::Height& height_m) {
  std::vector<Point3> points;
  for (const ClipperLib::IntPoint& p : path) {
    const Vec2 at = in_metres({p.X, p.Y});
    points.push_back({at.x, at.y, height_m(at)});
  }
  return points;
}

}  // namespace

Region Region::polygon(std::span<const Vec2> corners) {
  Ring ring;
  for (const Vec2& corner : corners) ring.push_back(on_grid(corner));
  if (ClipperLib::Area(path_of(ring)) < 0.0) std::reverse(ring.begin(), ring.end());
  Region region;
  region.rings_.push_back(std::move(ring));
  return region;
}

Region Region::rectangle(const Footprint& footprint) {
  Vec2 corners[4];
  for (int k = 0; k < 4; ++k) corners[k] = footprint.corner(k);
  return polygon(corners);
}

Region Region::disc(Vec2 centre, double radius_m) {
  std::vector<Vec2> corners;
  constexpr int kCorners = 32;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2.0 * M_PI * k / kCorners;
    corners.push_back(centre + Vec2{std::cos(angle), std::sin(angle)} * radius_m);
  }
  return polygon(corners);
}

Region Region::ribbon(std::span<const Vec2> line, double width_m) {
  Path path;
  for (const Vec2& p : line) path.emplace_back(on_grid(p).x, on_grid(p).y);
  ClipperLib::ClipperOffset offset(2.0, kArcTolerance_units);
  offset.AddPath(path, ClipperLib::jtRound, ClipperLib::etOpenButt);
  Paths result;
  offset.Execute(result, 0.5 * width_m * kUnits_per_m);
  Region region;
  region.rings_ = rings_of(result);
  return region;
}

Region operator+(const Region& a, const Region& b) {
  Region result;
  result.rings_ = rings_of(combined(ClipperLib::ctUnion, paths_of(a.rings_), paths_of(b.rings_)));
  return result;
}
Region operator-(const Region& a, const Region& b) {
  Region result;
  result.rings_ = rings_of(combined(ClipperLib::ctDifference, paths_of(a.rings_), paths_of(b.rings_)));
  return result;
}
Region operator&(const Region& a, const Region& b) {
  Region result;
  result.rings_ = rings_of(combined(ClipperLib::ctIntersection, paths_of(a.rings_), paths_of(b.rings_)));
  return result;
}

Region Region::all_of(std::span<const Region> parts) {
  Paths all;
  for (const Region& part : parts)
    for (const Ring& ring : part.rings_) all.push_back(path_of(ring));
  Region result;
  result.rings_ = rings_of(combined(ClipperLib::ctUnion, all, {}));
  return result;
}

Region Region::grown(double by_m) const {
  ClipperLib::ClipperOffset offset(2.0, kArcTolerance_units);
  offset.AddPaths(paths_of(rings_), ClipperLib::jtRound, ClipperLib::etClosedPolygon);
  Paths result;
  offset.Execute(result, by_m * kUnits_per_m);
  ClipperLib::CleanPolygons(result, 2.0);
  std::erase_if(result, [](const Path& path) { return path.size() < 3; });
  Region region;
  region.rings_ = rings_of(result);
  return region;
}

double Region::area_m2() const {
  double area = 0.0;
  for (const Ring& ring : rings_) area += ClipperLib::Area(path_of(ring));
  return area / (kUnits_per_m * kUnits_per_m);
}

bool Region::contains(Vec2 point) const {
  const Corner at = on_grid(point);
  int winding = 0;
  for (const Ring& ring : rings_) {
    const Path path = path_of(ring);
    if (ClipperLib::PointInPolygon({at.x, at.y}, path) != 0) winding += ClipperLib::Area(path) > 0.0 ? 1 : -1;
  }
  return winding > 0;
}

void Region::pave(MeshBuilder& mesh, const Height& height_m, double cell_m) const {
  if (rings_.empty()) return;
  Corner low = rings_.front().front(), high = low;
  for (const Ring& ring : rings_)
    for (const Corner& c : ring) {
      low = {std::min(low.x, c.x), std::min(low.y, c.y)};
      high = {std::max(high.x, c.x), std::max(high.y, c.y)};
    }
  const auto cell = static_cast<std::int64_t>(cell_m * kUnits_per_m);
  // Rows first, so that each cell is cut from its row and not from the whole.
  for (std::int64_t y = low.y; y < high.y; y += cell) {
    const Path band{{low.x, y}, {high.x, y}, {high.x, y + cell}, {low.x, y + cell}};
    Region row;
    row.rings_ = rings_of(combined(ClipperLib::ctIntersection, paths_of(rings_), {band}));
    for (std::int64_t x = low.x; x < high.x; x += cell)
      row.pave_cell(mesh, height_m, {x, y}, {x + cell, y + cell}, 0);
  }
}

void Region::pave_cell(MeshBuilder& mesh, const Height& height_m, Corner low, Corner high, int depth) const {
  const Path cell{{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}};
  const Paths inside = combined(ClipperLib::ctIntersection, paths_of(rings_), {cell});
  if (inside.empty()) return;
  const auto hole =
      std::find_if(inside.begin(), inside.end(), [](const Path& p) { return ClipperLib::Area(p) < 0.0; });
  // A cut through a hole makes it part of the rim on both sides; so holes need no bridges.
  if (hole != inside.end() && depth < 24) {
    const auto by_x = [](const auto& a, const auto& b) { return a.X < b.X; };
    const auto by_y = [](const auto& a, const auto& b) { return a.Y < b.Y; };
    const auto x = std::minmax_element(hole->begin(), hole->end(), by_x);
    const auto y = std::minmax_element(hole->begin(), hole->end(), by_y);
    Region part;
    part.rings_ = rings_of(inside);
    if (high.x - low.x >= high.y - low.y) {
      const std::int64_t cut = (x.first->X + x.second->X) / 2;
      part.pave_cell(mesh, height_m, low, {cut, high.y}, depth + 1);
      part.pave_cell(mesh, height_m, {cut, low.y}, high, depth + 1);
    } else {
      const std::int64_t cut = (y.first->Y + y.second->Y) / 2;
      part.pave_cell(mesh, height_m, low, {high.x, cut}, depth + 1);
      part.pave_cell(mesh, height_m, {low.x, cut}, high, depth + 1);
    }
    return;
  }
  for (const Path& path : inside)
    if (ClipperLib::Area(path) > 0.0) mesh.polygon(raised(path, height_m));
}

void Region::skirt(MeshBuilder& mesh, const Height& height_m, double low_m) const {
  for (const Ring& ring : rings_)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 a = in_metres(ring[k]), b = in_metres(ring[(k + 1) % ring.size()]);
      mesh.quad({a.x, a.y, low_m}, {b.x, b.y, low_m}, {b.x, b.y, height_m(b)}, {a.x, a.y, height_m(a)});
    }
}

}  // namespace ifov::landscape
