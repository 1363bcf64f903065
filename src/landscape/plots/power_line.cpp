#include "landscape/plots/power_line.h"

#include <algorithm>
#include <array>

#include "landscape/shapes/mesh_builder.h"

namespace ifov::landscape {
namespace {

using Section = StreetSection;

constexpr double kSpan_m = 38.0, kPole_m = 10.5, kArm_m = 9.9;
constexpr double kSag_m = 0.7;

struct Attachment {
  double across, height;
};
constexpr std::array<Attachment, 4> kWires{
    {{-1.05, kArm_m + 0.32}, {0.35, kArm_m + 0.32}, {1.05, kArm_m + 0.32}, {-0.2, 8.3}}};

}  // namespace

PowerLine plan_power_line(const Street& street, std::span<const Plot> plots, double half_m) {
  PowerLine line;
  const double total = street.length_m();
  const auto stand_at = [&](double along) {
    const Vec2 way = street.direction(along);
    return Stand{street.at(along) + left_of(way) * (0.5 * street.width + Section::kKerb + 0.55), way};
  };
  const auto is_free = [&](const Stand& stand) {
    return std::none_of(plots.begin(), plots.end(),
                        [&](const Plot& plot) { return distance(plot.driveway, stand.origin) < 0.8; });
  };
  for (double along = 5.0; along < total - 4.0; along += kSpan_m) {
    Stand stand = stand_at(along);
    for (int step = 1; step < 8 && !is_free(stand); ++step) stand = stand_at(along + step);
    if (std::max(std::abs(stand.origin.x), std::abs(stand.origin.y)) < half_m - 0.5)
      line.poles.push_back(stand);
  }
  return line;
}

geometry::TriangleMesh pole_mesh() {
  MeshBuilder mesh;
  mesh.slot("pole");
  mesh.tube(std::array<Point3, 2>{{{0, 0, -0.1}, {0, 0, kPole_m}}}, std::array{0.16, 0.105}, 12, true);
  mesh.box({-1.25, 0.1, kArm_m - 0.06}, {1.25, 0.2, kArm_m + 0.06});
  mesh.slot("steel");
  for (const double side : {-1.0, 1.0})
    mesh.tube({0.0, 0.15, kArm_m - 0.75}, {side * 0.8, 0.15, kArm_m - 0.05}, 0.012, 5);
  // A transformer hangs below the arm.
  mesh.tube({0.32, -0.2, 7.0}, {0.32, -0.2, 7.95}, 0.24, 14);
  mesh.slot("insulator");
  for (const Attachment& wire : kWires) {
    if (wire.height > kArm_m)
      mesh.tube(std::array<Point3, 3>{{{wire.across, 0.15, kArm_m + 0.06},
                                       {wire.across, 0.15, kArm_m + 0.2},
                                       {wire.across, 0.15, wire.height}}},
                std::array{0.03, 0.065, 0.035}, 10, true);
    else
      mesh.tube({wire.across, 0.0, wire.height - 0.06}, {wire.across, 0.0, wire.height + 0.04}, 0.04, 8);
  }
  return mesh.take();
}

geometry::TriangleMesh wire_mesh(const PowerLine& line, double ground_m) {
  MeshBuilder mesh;
  mesh.slot("wire");
  constexpr int kPieces = 14;
  for (std::size_t k = 0; k + 1 < line.poles.size(); ++k)
    for (const Attachment& wire : kWires) {
      const double forward = wire.height > kArm_m ? 0.15 : 0.0;
      const Vec2 a = line.poles[k].at(wire.across, forward), b = line.poles[k + 1].at(wire.across, forward);
      std::vector<Point3> axis;
      for (int p = 0; p <= kPieces; ++p) {
        const double t = static_cast<double>(p) / kPieces;
        const Vec2 at = a + (b - a) * t;
        axis.push_back({at.x, at.y, ground_m + wire.height - 4.0 * kSag_m * t * (1.0 - t)});
      }
      mesh.tube(axis, std::vector<double>(axis.size(), 0.009), 5, true);
    }
  return mesh.take();
}

}  // namespace ifov::landscape
