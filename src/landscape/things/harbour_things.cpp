#include "landscape/things/harbour_things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "landscape/shapes/mesh_builder.h"

namespace ifov::landscape {
namespace {

void add_container(MeshBuilder& mesh, Point3 middle_of_floor) {
  constexpr double kLength = 6.06, kWidth = 2.44, kHeight = 2.59, kRib = 0.036;
  const Point3 low{middle_of_floor.x - 0.5 * kLength, middle_of_floor.y - 0.5 * kWidth, middle_of_floor.z};
  mesh.slot("container");
  mesh.box({low.x, low.y + kRib, low.z}, {low.x + kLength, low.y + kWidth - kRib, low.z + kHeight});
  // Ribs stand out on the long sides; frames close the corners.
  constexpr int kRibs = 20;
  for (int k = 0; k < kRibs; ++k) {
    const double x = low.x + 0.2 + (kLength - 0.4) * (k + 0.25) / kRibs, half = 0.5 * (kLength - 0.4) / kRibs;
    mesh.box({x, low.y, low.z + 0.15}, {x + half, low.y + kRib, low.z + kHeight - 0.1});
    mesh.box({x, low.y + kWidth - kRib, low.z + 0.15}, {x + half, low.y + kWidth, low.z + kHeight - 0.1});
  }
}

/// Half width of a hull at a share of its length (0 stern, 1 bow).
double half_beam(double t, double beam, double rake) {
  const double stern = std::clamp(0.72 + 2.4 * t, 0.0, 1.0);
  const double bow = t < 0.8 ? 1.0 : std::sqrt(std::max(0.0, 1.0 - std::pow((t - 0.8) / 0.2, 2.0)));
  return 0.5 * beam * std::min(stern, bow) * rake;
}

}  // namespace

geometry::TriangleMesh container_mesh() {
  MeshBuilder mesh;
  add_container(mesh, {0.0, 0.0, 0.0});
  return mesh.take();
}

geometry::TriangleMesh ship_mesh(double length, double beam) {
  MeshBuilder mesh;
  constexpr int kSections = 40;
  const double freeboard = 0.055 * length, draught = 0.6;
  const auto rim = [&](int k, double side, double z, double rake) {
    const double t = static_cast<double>(k) / kSections;
    const double sheer = std::max(0.0, t - 0.8) * 0.12 * length * (z > 1.0 ? 1.0 : 0.0);
    return Point3{(t - 0.5) * length, side * half_beam(t, beam, rake), z + sheer};
  };
  const auto belt = [&](const char* slot, double low, double high) {
    mesh.slot(slot);
    for (int k = 0; k < kSections; ++k) {
      mesh.quad(rim(k, -1.0, low, 0.97), rim(k + 1, -1.0, low, 0.97), rim(k + 1, -1.0, high, 1.0),
                rim(k, -1.0, high, 1.0));
      mesh.quad(rim(k + 1, 1.0, low, 0.97), rim(k, 1.0, low, 0.97), rim(k, 1.0, high, 1.0),
                rim(k + 1, 1.0, high, 1.0));
    }
    mesh.quad(rim(0, 1.0, low, 0.97), rim(0, -1.0, low, 0.97), rim(0, -1.0, high, 1.0),
              rim(0, 1.0, high, 1.0));
  };
  belt("bottom", -draught, 1.0);
  belt("hull", 1.0, freeboard + 0.9);
  mesh.slot("deck");
  for (int k = 0; k < kSections; ++k)
    mesh.quad(rim(k, -1.0, freeboard, 0.99), rim(k + 1, -1.0, freeboard, 0.99),
              rim(k + 1, 1.0, freeboard, 0.99), rim(k, 1.0, freeboard, 0.99));
  const double aft = -0.5 * length + 0.05 * length, depth = std::min(0.13 * length, 14.0), half = 0.42 * beam;
  mesh.slot("house");
  const int decks = length > 60.0 ? 5 : 2;
  for (int d = 0; d < decks; ++d) {
    const double z = freeboard + 2.7 * d, inset = 0.25 * d;
    mesh.slot("house");
    mesh.box({aft + inset, -half + inset, z}, {aft + depth - inset, half - inset, z + 2.7});
    mesh.slot("window");
    mesh.box({aft + depth - inset, -half + inset + 0.6, z + 1.3},
             {aft + depth - inset + 0.02, half - inset - 0.6, z + 2.1});
  }
  const double top = freeboard + 2.7 * decks;
  mesh.slot("trim");
  mesh.tube({aft + 0.6 * depth, 0.0, top}, {aft + 0.6 * depth, 0.0, top + 6.0}, 0.15, 8);
  mesh.box({aft + 0.6 * depth - 0.1, -1.6, top + 3.5}, {aft + 0.6 * depth + 0.1, 1.6, top + 3.7});
  mesh.slot("hull");
  mesh.box({aft + 0.15 * depth, -1.3, top}, {aft + 0.4 * depth, 1.3, top + 3.2});
  if (length > 60.0) {
    // Hatches of the holds.
    mesh.slot("trim");
    for (double x = aft + depth + 4.0; x + 13.0 < 0.36 * length; x += 15.0)
      mesh.box({x, -0.36 * beam, freeboard}, {x + 13.0, 0.36 * beam, freeboard + 1.3});
  }
  return mesh.take();
}

geometry::TriangleMesh crane_mesh() {
  MeshBuilder mesh;
  constexpr double kBoom = 30.0, kPortal = 15.0, kHalf = 8.0;
  mesh.slot("steel");
  for (const double x : {-kHalf, kHalf}) {
    for (const double y : {0.0, kPortal}) {
      mesh.box({x - 0.6, y - 0.6, 1.2}, {x + 0.6, y + 0.6, kBoom});
      mesh.box({x - 2.6, y - 0.45, 0.25}, {x + 2.6, y + 0.45, 1.2});
      for (const double wheel : {-2.0, -0.7, 0.7, 2.0})
        mesh.tube({x + wheel, y - 0.2, 0.3}, {x + wheel, y + 0.2, 0.3}, 0.3, 10);
    }
    mesh.box({x - 0.5, 0.0, 12.0}, {x + 0.5, kPortal, 13.2});
    mesh.tube({x, 0.0, 13.2}, {x, kPortal, kBoom - 1.0}, 0.3, 8);
    mesh.box({x - 0.45, -0.4, kBoom}, {x + 0.45, kPortal + 0.4, kBoom + 1.0});
  }
  for (const double y : {0.0, kPortal}) mesh.box({-kHalf, y - 0.4, kBoom - 1.4}, {kHalf, y + 0.4, kBoom});
  for (const double x : {-2.4, 2.4}) {
    mesh.box({x - 0.4, -14.0, kBoom + 1.0}, {x + 0.4, 45.0, kBoom + 2.6});
    mesh.tube({x, kPortal, kBoom + 14.0}, {x, 36.0, kBoom + 2.6}, 0.16, 6);
    mesh.tube({x, kPortal, kBoom + 14.0}, {x, -12.0, kBoom + 2.6}, 0.16, 6);
    mesh.tube({x, kPortal, kBoom + 2.6}, {x, kPortal, kBoom + 14.0}, 0.35, 8);
  }
  for (double y = -14.0; y < 45.0; y += 4.5) mesh.box({-2.4, y, kBoom + 1.3}, {2.4, y + 0.3, kBoom + 1.6});
  mesh.box({-3.6, -12.0, kBoom + 2.6}, {3.6, -4.0, kBoom + 6.4});
  mesh.box({-2.6, 24.0, kBoom + 0.3}, {2.6, 27.0, kBoom + 1.0});
  mesh.slot("cable");
  for (const double x : {-2.0, 2.0})
    for (const double y : {24.5, 26.5}) mesh.tube({x, y, 14.6}, {x, y, kBoom + 0.4}, 0.02, 4);
  mesh.slot("steel");
  mesh.box({-3.0, 24.3, 14.2}, {3.0, 26.7, 14.6});
  mesh.slot("window");
  mesh.box({2.7, 22.0, kBoom - 2.4}, {4.6, 24.0, kBoom + 0.2});
  return mesh.take();
}

geometry::TriangleMesh shed_mesh(double length, double width) {
  MeshBuilder mesh;
  const double x = 0.5 * length, y = 0.5 * width, wall = 7.0, ridge = wall + 0.18 * y, over = 0.4,
               thick = 0.15;
  mesh.slot("wall");
  mesh.quad({-x, -y, 0}, {x, -y, 0}, {x, -y, wall}, {-x, -y, wall});
  mesh.quad({x, y, 0}, {-x, y, 0}, {-x, y, wall}, {x, y, wall});
  mesh.polygon(std::array<Point3, 5>{{{x, -y, 0}, {x, y, 0}, {x, y, wall}, {x, 0, ridge}, {x, -y, wall}}});
  mesh.polygon(
      std::array<Point3, 5>{{{-x, y, 0}, {-x, -y, 0}, {-x, -y, wall}, {-x, 0, ridge}, {-x, y, wall}}});
  const double drop = 0.18 * over, eave = wall + 0.5 * thick - drop, top = ridge + 0.5 * thick;
  const std::vector<std::vector<Point3>> faces{
      {{-x - over, -y - over, eave}, {x + over, -y - over, eave}, {x + over, 0, top}, {-x - over, 0, top}},
      {{x + over, y + over, eave}, {-x - over, y + over, eave}, {-x - over, 0, top}, {x + over, 0, top}}};
  mesh.slot("roof");
  mesh.slab(faces, thick);
  for (double at = -x + 8.0; at < x - 5.0; at += 14.0)
    for (const double side : {-1.0, 1.0}) {
      mesh.slot("door");
      mesh.box({at - 2.5, std::min(side * y, side * (y + 0.06)), 0.0},
               {at + 2.5, std::max(side * y, side * (y + 0.06)), 4.8});
    }
  mesh.slot("trim");
  for (double at = -x + 6.0; at < x - 4.0; at += 9.0) {
    const double z = top - 0.18 * 0.5 * y;
    mesh.box({at - 0.6, -0.5 * y - 0.6, z - 0.3}, {at + 0.6, -0.5 * y + 0.6, z + 0.5});
  }
  return mesh.take();
}

geometry::TriangleMesh lorry_mesh() {
  MeshBuilder mesh;
  mesh.slot("bed");
  mesh.box({-4.2, -1.1, 0.95}, {2.2, 1.1, 1.2});
  add_container(mesh, {-1.1, 0.0, 1.2});
  mesh.slot("cab");
  mesh.box({2.4, -1.2, 0.7}, {4.5, 1.2, 2.0});
  mesh.box({2.4, -1.15, 2.0}, {4.35, 1.15, 3.1});
  mesh.slot("glass");
  mesh.box({4.35, -1.0, 2.05}, {4.37, 1.0, 2.9});
  mesh.slot("tyre");
  for (const double x : {-3.4, -2.2, 3.4})
    for (const double side : {-1.0, 1.0}) mesh.tube({x, side * 0.75, 0.5}, {x, side * 1.15, 0.5}, 0.5, 14);
  return mesh.take();
}

}  // namespace ifov::landscape
