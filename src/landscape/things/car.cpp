#include "landscape/things/car.h"

#include <algorithm>
#include <array>
#include <vector>

#include "landscape/shapes/mesh_builder.h"

namespace ifov::landscape {
namespace {

/// A cross-section of the body at a place along the car: half widths and heights of its sill, waist and bonnet.
struct Section {
  double x, sill_half, waist_half, top_half, sill, waist, top;
};

/// The glass house: base and roof rectangles, front and back.
struct Cabin {
  double base_back, base_front, roof_back, roof_front, base_half, roof_half, base, roof;
};

struct Shape {
  std::vector<Section> body;
  Cabin cabin;
  double axle_back, axle_front;
};

Shape shape_of(CarKind kind) {
  switch (kind) {
    case CarKind::sedan:
      return {{{-2.32, .70, .78, .70, .38, .62, .82},
               {-2.15, .82, .88, .80, .24, .68, .95},
               {-1.45, .86, .91, .84, .20, .72, 1.00},
               {0.95, .86, .91, .84, .20, .72, .98},
               {1.90, .84, .88, .76, .22, .66, .84},
               {2.28, .72, .78, .62, .32, .58, .70}},
              {-1.75, 1.10, -0.95, 0.25, .83, .62, .97, 1.45},
              -1.38,
              1.40};
    case CarKind::estate:
      return {{{-2.22, .74, .80, .76, .38, .70, .98},
               {-2.05, .84, .90, .84, .24, .76, 1.08},
               {0.95, .88, .92, .86, .22, .78, 1.08},
               {1.80, .84, .89, .78, .24, .72, .96},
               {2.20, .74, .80, .66, .34, .64, .80}},
              {-2.12, 1.15, -1.85, 0.35, .84, .66, 1.06, 1.66},
              -1.34,
              1.38};
    case CarKind::van:
      return {{{-2.45, .82, .88, .86, .36, .80, 1.25},
               {-2.35, .90, .95, .92, .26, .84, 1.30},
               {1.35, .90, .95, .92, .24, .84, 1.25},
               {2.05, .88, .93, .82, .26, .78, 1.02},
               {2.42, .78, .84, .70, .36, .70, .86}},
              {-2.42, 1.75, -2.36, 0.95, .90, .78, 1.24, 1.98},
              -1.45,
              1.55};
  }
  return {};
}

/// Half of a ring, from the middle of the floor over the right side to the middle of the top.
std::array<Point3, 6> half_ring(const Section& s) {
  return {{{s.x, 0.0, s.sill},
           {s.x, s.sill_half, s.sill},
           {s.x, s.waist_half, s.waist},
           {s.x, s.top_half + 0.03, s.top - 0.07},
           {s.x, s.top_half - 0.06, s.top},
           {s.x, 0.0, s.top + 0.02}}};
}

void body(MeshBuilder& mesh, const std::vector<Section>& sections) {
  mesh.slot("body");
  const auto mirrored = [](Point3 p) { return Point3{p.x, -p.y, p.z}; };
  for (std::size_t k = 0; k + 1 < sections.size(); ++k) {
    const auto back = half_ring(sections[k]), front = half_ring(sections[k + 1]);
    for (std::size_t r = 0; r + 1 < back.size(); ++r) {
      mesh.quad(back[r], back[r + 1], front[r + 1], front[r]);
      mesh.quad(mirrored(front[r]), mirrored(front[r + 1]), mirrored(back[r + 1]), mirrored(back[r]));
    }
  }
  for (const bool front : {false, true}) {
    const auto ring = half_ring(front ? sections.back() : sections.front());
    std::vector<Point3> face(ring.begin(), ring.end());
    for (std::size_t k = ring.size() - 1; k-- > 1;) face.push_back(mirrored(ring[k]));
    if (!front) std::reverse(face.begin(), face.end());
    mesh.polygon(face);
  }
}

void cabin(MeshBuilder& mesh, const Cabin& c) {
  const auto corner = [&](bool top, bool front, bool left) {
    const double half = top ? c.roof_half : c.base_half;
    const double x = top ? (front ? c.roof_front : c.roof_back) : (front ? c.base_front : c.base_back);
    return Point3{x, left ? half : -half, top ? c.roof : c.base};
  };
  const auto face = [&](Point3 a, Point3 b, Point3 d, Point3 e) { mesh.quad(a, b, d, e); };
  mesh.slot("glass");
  face(corner(false, true, false), corner(false, true, true), corner(true, true, true),
       corner(true, true, false));
  face(corner(false, false, true), corner(false, false, false), corner(true, false, false),
       corner(true, false, true));
  face(corner(false, false, false), corner(false, true, false), corner(true, true, false),
       corner(true, false, false));
  face(corner(false, true, true), corner(false, false, true), corner(true, false, true),
       corner(true, true, true));
  mesh.slot("body");
  mesh.quad(corner(true, false, false), corner(true, true, false), corner(true, true, true),
            corner(true, false, true));
  // Pillars: at the corners and between the doors.
  for (const bool left : {false, true}) {
    for (const bool front : {false, true})
      mesh.tube(corner(false, front, left), corner(true, front, left), 0.045, 4);
    const double half_base = left ? c.base_half : -c.base_half, half_roof = left ? c.roof_half : -c.roof_half;
    const double middle = 0.5 * (c.roof_back + c.roof_front) - 0.1;
    mesh.tube({middle, half_base, c.base}, {middle, half_roof, c.roof}, 0.04, 4);
    mesh.tube(corner(true, false, left), corner(true, true, left), 0.035, 4);
  }
}

void wheel(MeshBuilder& mesh, double x, double side) {
  constexpr double kRadius = 0.32;
  mesh.slot("tyre");
  mesh.tube({x, side * 0.70, kRadius}, {x, side * 0.93, kRadius}, kRadius, 16);
  mesh.slot("trim");
  mesh.tube({x, side * 0.92, kRadius}, {x, side * 0.94, kRadius}, 0.2, 12);
}

void lamps(MeshBuilder& mesh, const std::vector<Section>& sections) {
  mesh.slot("lamp");
  for (const bool front : {false, true}) {
    const Section& end = front ? sections.back() : sections.front();
    const double x = end.x + (front ? 0.01 : -0.01), z = 0.5 * (end.waist + end.top);
    for (const double side : {-1.0, 1.0}) {
      const double y0 = side * (end.top_half - 0.28), y1 = side * (end.top_half - 0.06);
      mesh.box({x - 0.02, std::min(y0, y1), z - 0.07}, {x + 0.02, std::max(y0, y1), z + 0.05});
    }
  }
}

}  // namespace

geometry::TriangleMesh car_mesh(CarKind kind) {
  const Shape shape = shape_of(kind);
  MeshBuilder mesh;
  body(mesh, shape.body);
  cabin(mesh, shape.cabin);
  for (const double x : {shape.axle_back, shape.axle_front})
    for (const double side : {-1.0, 1.0}) wheel(mesh, x, side);
  lamps(mesh, shape.body);
  return mesh.take();
}

}  // namespace ifov::landscape
