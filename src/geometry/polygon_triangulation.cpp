#include "geometry/polygon_triangulation.h"

#include <cmath>
#include <numeric>

namespace ifov::geometry {
namespace {

using math::Point3;
using math::Vec3;

struct Flat {
  double x, y;
};

double twice_area(Flat a, Flat b, Flat c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// Onto the two axes in which the polygon is largest, keeping its winding counter-clockwise.
std::vector<Flat> flattened(std::span<const Point3> vertices_m, Vec3 normal) {
  const double ax = std::abs(normal.x), ay = std::abs(normal.y), az = std::abs(normal.z);
  std::vector<Flat> flat;
  flat.reserve(vertices_m.size());
  const Point3 origin = vertices_m.front();
  for (const Point3& p : vertices_m) {
    const Vec3 v = p - origin;
    if (az >= ax && az >= ay)
      flat.push_back(normal.z > 0.0 ? Flat{v.x, v.y} : Flat{v.y, v.x});
    else if (ax >= ay)
      flat.push_back(normal.x > 0.0 ? Flat{v.y, v.z} : Flat{v.z, v.y});
    else
      flat.push_back(normal.y > 0.0 ? Flat{v.z, v.x} : Flat{v.x, v.z});
  }
  return flat;
}

/// The corner at `b` between its neighbours is convex and holds no other corner of what is left.
bool is_ear(const std::vector<Flat>& flat, const std::vector<std::uint32_t>& left, std::size_t at) {
  const std::size_t n = left.size();
  const Flat a = flat[left[(at + n - 1) % n]], b = flat[left[at]], c = flat[left[(at + 1) % n]];
  if (!(twice_area(a, b, c) > 0.0)) return false;
  for (std::size_t k = 2; k + 1 < n; ++k) {
    const Flat p = flat[left[(at + k) % n]];
    const bool corner =
        (p.x == a.x && p.y == a.y) || (p.x == b.x && p.y == b.y) || (p.x == c.x && p.y == c.y);
    if (!corner && twice_area(a, b, p) >= 0.0 && twice_area(b, c, p) >= 0.0 && twice_area(c, a, p) >= 0.0)
      return false;
  }
  return true;
}

}  // namespace

Vec3 polygon_area_vector(std::span<const Point3> vertices_m) {
  Vec3 sum;
  for (std::size_t k = 1; k + 1 < vertices_m.size(); ++k)
    sum = sum + cross(vertices_m[k] - vertices_m[0], vertices_m[k + 1] - vertices_m[0]);
  return sum;
}

std::vector<Triangle> triangulate_polygon(std::span<const Point3> vertices_m) {
  std::vector<Triangle> triangles;
  if (vertices_m.size() < 3) return triangles;
  const auto n = static_cast<std::uint32_t>(vertices_m.size());
  triangles.reserve(n - 2);
  if (n == 3) return {{0, 1, 2}};
  const std::vector<Flat> flat = flattened(vertices_m, polygon_area_vector(vertices_m));
  std::vector<std::uint32_t> left(n);
  std::iota(left.begin(), left.end(), 0u);
  std::size_t at = 1, tried = 0;
  while (left.size() > 3) {
    // A polygon without an ear crosses itself or has no area: cut it all the same, so that every corner is
    // used.
    if (is_ear(flat, left, at % left.size()) || tried == left.size()) {
      const std::size_t k = at % left.size(), m = left.size();
      triangles.push_back({left[(k + m - 1) % m], left[k], left[(k + 1) % m]});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
      tried = 0;
      at = k;  // the corner after the ear: neighbours of an ear are cut in turn, which avoids fans of slivers
    } else {
      ++at;
      ++tried;
    }
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace ifov::geometry
