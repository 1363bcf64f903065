#include "landscape/shapes/mesh_builder.h"

#include <algorithm>
#include <cmath>

#include "geometry/polygon_triangulation.h"

namespace ifov::landscape {

void MeshBuilder::slot(std::string_view name) {
  const auto found = std::find(mesh_.slot_names.begin(), mesh_.slot_names.end(), name);
  slot_ = static_cast<std::uint32_t>(found - mesh_.slot_names.begin());
  if (found == mesh_.slot_names.end()) mesh_.slot_names.emplace_back(name);
}

std::uint32_t MeshBuilder::vertex(Point3 p) {
  mesh_.vertices_m.push_back(mesh_from_part_(p));
  return static_cast<std::uint32_t>(mesh_.vertices_m.size() - 1);
}

void MeshBuilder::triangle(Point3 a, Point3 b, Point3 c) {
  const std::uint32_t first = vertex(a);
  vertex(b), vertex(c);
  mesh_.triangles.push_back({first, first + 1, first + 2});
  mesh_.slots.push_back(slot_);
}

void MeshBuilder::quad(Point3 a, Point3 b, Point3 c, Point3 d) {
  const std::uint32_t first = vertex(a);
  vertex(b), vertex(c), vertex(d);
  mesh_.triangles.push_back({first, first + 1, first + 2});
  mesh_.triangles.push_back({first, first + 2, first + 3});
  mesh_.slots.insert(mesh_.slots.end(), 2, slot_);
}

void MeshBuilder::polygon(std::span<const Point3> vertices_m) {
  const auto first = static_cast<std::uint32_t>(mesh_.vertices_m.size());
  for (const Point3& p : vertices_m) vertex(p);
  for (const geometry::Triangle& t : geometry::triangulate_polygon(vertices_m)) {
    mesh_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    mesh_.slots.push_back(slot_);
  }
}

void MeshBuilder::box(Point3 low, Point3 high) {
  const auto corner = [&](int k) {
    return Point3{(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                  (k & 4) != 0 ? high.z : low.z};
  };
  constexpr int kFaces[6][4] = {{4, 5, 7, 6}, {0, 2, 3, 1}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {1, 3, 7, 5}, {0, 4, 6, 2}};
  for (const auto& face : kFaces) quad(corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3]));
}

void MeshBuilder::tube(std::span<const Point3> axis, std::span<const double> radii, int sides,
                       bool closed_ends) {
  const auto ring_size = static_cast<std::uint32_t>(sides);
  const auto first = static_cast<std::uint32_t>(mesh_.vertices_m.size());
  Vec3 side;
  for (std::size_t k = 0; k < axis.size(); ++k) {
    const Vec3 direction = math::normalized(axis[std::min(k + 1, axis.size() - 1)] - axis[k > 0 ? k - 1 : 0]);
    // The first side is any normal of the axis; later ones are the one before, turned as little as possible.
    if (k == 0) side = std::abs(direction.z) < 0.9 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
    side = math::normalized(side - direction * math::dot(side, direction));
    const Vec3 other = math::cross(direction, side);
    for (int s = 0; s < sides; ++s) {
      const double angle = 2.0 * M_PI * s / sides;
      vertex(axis[k] + (side * std::cos(angle) + other * std::sin(angle)) * radii[k]);
    }
    if (k == 0) continue;
    const std::uint32_t low = first + static_cast<std::uint32_t>(k - 1) * ring_size, high = low + ring_size;
    for (std::uint32_t s = 0; s < ring_size; ++s) {
      const std::uint32_t next = (s + 1) % ring_size;
      mesh_.triangles.push_back({low + s, low + next, high + next});
      mesh_.triangles.push_back({low + s, high + next, high + s});
      mesh_.slots.insert(mesh_.slots.end(), 2, slot_);
    }
  }
  if (!closed_ends) return;
  const std::uint32_t last = first + static_cast<std::uint32_t>(axis.size() - 1) * ring_size;
  for (std::uint32_t s = 1; s + 1 < ring_size; ++s) {
    mesh_.triangles.push_back({first, first + s + 1, first + s});
    mesh_.triangles.push_back({last, last + s, last + s + 1});
    mesh_.slots.insert(mesh_.slots.end(), 2, slot_);
  }
}

void MeshBuilder::tube(Point3 from_m, Point3 to_m, double radius_m, int sides) {
  const Point3 axis[] = {from_m, to_m};
  const double radii[] = {radius_m, radius_m};
  tube(axis, radii, sides, true);
}

void MeshBuilder::slab(std::span<const std::vector<Point3>> faces, double thickness_m) {
  const Vec3 down{0.0, 0.0, -thickness_m};
  const auto is_shared = [&](Point3 a, Point3 b) {
    for (const std::vector<Point3>& face : faces)
      for (std::size_t k = 0; k < face.size(); ++k)
        if (face[k] == b && face[(k + 1) % face.size()] == a) return true;
    return false;
  };
  for (const std::vector<Point3>& face : faces) {
    polygon(face);
    std::vector<Point3> under;
    for (std::size_t k = face.size(); k-- > 0;) under.push_back(face[k] + down);
    polygon(under);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Point3 a = face[k], b = face[(k + 1) % face.size()];
      if (!is_shared(a, b)) quad(a, a + down, b + down, b);
    }
  }
}

}  // namespace ifov::landscape
