#include "landscape/things/court.h"

#include <algorithm>
#include <cmath>

#include "landscape/shapes/mesh_builder.h"

namespace ifov::landscape {
namespace {

using Size = CourtSize;

constexpr double kSurface_m = 0.03;
constexpr double kPaint_m = 0.002;

void flat(MeshBuilder& mesh, double x0, double x1, double y0, double y1, double z) {
  mesh.quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
}

void surfaces(MeshBuilder& mesh) {
  const double x = 0.5 * Size::kLot_length, y = 0.5 * Size::kLot_width;
  const double cx = 0.5 * Size::kLength, cy = 0.5 * Size::kDoubles_width;
  mesh.slot("concrete");
  mesh.quad({-x, -y, -0.1}, {x, -y, -0.1}, {x, -y, kSurface_m}, {-x, -y, kSurface_m});
  mesh.quad({x, y, -0.1}, {-x, y, -0.1}, {-x, y, kSurface_m}, {x, y, kSurface_m});
  mesh.quad({x, -y, -0.1}, {x, y, -0.1}, {x, y, kSurface_m}, {x, -y, kSurface_m});
  mesh.quad({-x, y, -0.1}, {-x, -y, -0.1}, {-x, -y, kSurface_m}, {-x, y, kSurface_m});
  mesh.slot("surround");
  flat(mesh, -x, x, -y, -cy, kSurface_m);
  flat(mesh, -x, x, cy, y, kSurface_m);
  flat(mesh, -x, -cx, -cy, cy, kSurface_m);
  flat(mesh, cx, x, -cy, cy, kSurface_m);
  mesh.slot("court");
  flat(mesh, -cx, cx, -cy, cy, kSurface_m);
}

/// Lines do not overlap: those across run between those along.
void lines(MeshBuilder& mesh) {
  mesh.slot("line");
  const double z = kSurface_m + kPaint_m, w = Size::kLine;
  const double x = 0.5 * Size::kLength, doubles = 0.5 * Size::kDoubles_width,
               singles = 0.5 * Size::kSingles_width;
  for (const double side : {-1.0, 1.0}) {
    const auto along = [&](double outer) {
      const double y0 = side * outer, y1 = side * (outer - w);
      flat(mesh, -x, x, std::min(y0, y1), std::max(y0, y1), z);
    };
    along(doubles);
    along(singles);
    const auto across = [&](double far, double from_y, double to_y) {
      const double x0 = side * far, x1 = side * (far - w);
      flat(mesh, std::min(x0, x1), std::max(x0, x1), from_y, to_y, z);
    };
    across(x, -doubles + w, -singles);
    across(x, -singles + w, singles - w);
    across(x, singles, doubles - w);
    across(Size::kService_line, -singles + w, singles - w);
    const double mark0 = side * (x - w), mark1 = side * (x - w - Size::kCentre_mark);
    flat(mesh, std::min(mark0, mark1), std::max(mark0, mark1), -0.5 * w, 0.5 * w, z);
  }
  flat(mesh, -Size::kService_line + w, Size::kService_line - w, -0.5 * w, 0.5 * w, z);
}

double net_height(double y) {
  const double reach = 0.5 * Size::kDoubles_width + Size::kPost_out;
  return Size::kNet_middle + (Size::kPost_height - Size::kNet_middle) * (y / reach) * (y / reach);
}

void net(MeshBuilder& mesh) {
  const double reach = 0.5 * Size::kDoubles_width + Size::kPost_out;
  mesh.slot("steel");
  for (const double side : {-1.0, 1.0})
    mesh.tube({0.0, side * reach, 0.0}, {0.0, side * reach, Size::kPost_height + kSurface_m}, 0.038, 12);
  constexpr int kPieces = 24;
  const auto y_of = [&](int k) { return -reach + 2.0 * reach * k / kPieces; };
  mesh.slot("line");
  for (int k = 0; k < kPieces; ++k) {
    const double y0 = y_of(k), y1 = y_of(k + 1), z0 = net_height(y0) + kSurface_m,
                 z1 = net_height(y1) + kSurface_m;
    mesh.quad({0.0, y0, z0 - 0.06}, {0.0, y1, z1 - 0.06}, {0.0, y1, z1}, {0.0, y0, z0});
  }
  // Cords 5 cm apart, 3 mm thick, as flat strips.
  mesh.slot("net");
  constexpr double kMesh = 0.05, kCord = 0.003;
  for (double y = -reach + kMesh; y < reach; y += kMesh)
    mesh.quad({0.0, y, kSurface_m}, {0.0, y + kCord, kSurface_m}, {0.0, y + kCord, net_height(y) - 0.03},
              {0.0, y, net_height(y) - 0.03});
  for (double z = kMesh; z < Size::kNet_middle - 0.06; z += kMesh)
    mesh.quad({0.0, -reach, z + kSurface_m}, {0.0, reach, z + kSurface_m},
              {0.0, reach, z + kSurface_m + kCord}, {0.0, -reach, z + kSurface_m + kCord});
}

void fence(MeshBuilder& mesh) {
  mesh.slot("steel");
  const double x = 0.5 * Size::kLot_length - 0.1, y = 0.5 * Size::kLot_width - 0.1, top = 3.0;
  const auto side = [&](Point3 from, Point3 to, bool gate) {
    const Vec3 way = to - from;
    const int posts = static_cast<int>(std::round(math::length(way) / 3.0));
    for (int k = 0; k < posts; ++k) {
      const Point3 foot = from + way * (static_cast<double>(k) / posts);
      mesh.tube(foot, foot + Vec3{0.0, 0.0, top}, 0.03, 8);
    }
    for (const double z : {1.5, top}) {
      if (gate && z < 2.0) continue;
      mesh.tube(from + Vec3{0.0, 0.0, z}, to + Vec3{0.0, 0.0, z}, 0.021, 6);
    }
    // Wire mesh: level strands 10 cm apart.
    for (double z = 0.1; z < top && !gate; z += 0.1)
      mesh.tube(from + Vec3{0, 0, z}, to + Vec3{0, 0, z}, 0.0015, 3);
  };
  side({-x, -y, 0.0}, {x, -y, 0.0}, true);
  side({x, -y, 0.0}, {x, y, 0.0}, false);
  side({x, y, 0.0}, {-x, y, 0.0}, false);
  side({-x, y, 0.0}, {-x, -y, 0.0}, false);
}

}  // namespace

geometry::TriangleMesh court_mesh() {
  MeshBuilder mesh;
  surfaces(mesh);
  lines(mesh);
  net(mesh);
  fence(mesh);
  return mesh.take();
}

}  // namespace ifov::landscape
