#include "landscape/terrain/rock.h"

#include <cmath>

#include "landscape/shapes/mesh_builder.h"

namespace ifov::landscape {

geometry::TriangleMesh rock_mesh(const RandomStream& random) {
  MeshBuilder mesh;
  mesh.slot("rock");
  constexpr int kRings = 8, kSides = 14;
  const auto at = [&](int ring, int side) {
    const double polar = M_PI * ring / kRings, azimuth = 2.0 * M_PI * (side % kSides) / kSides;
    const Vec3 out{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
    const double bulge = 0.36 + 0.3 * fractal_noise(random, 1.6 * out.x + 7.0 + out.z,
                                                    1.6 * out.y + 3.0 - 0.7 * out.z, 1.0, 3);
    return Point3{out.x * bulge, out.y * bulge * 0.85, out.z * bulge * 0.7 + 0.12};
  };
  for (int ring = 0; ring < kRings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      if (ring > 0) mesh.triangle(at(ring, side), at(ring + 1, side), at(ring, side + 1));
      if (ring + 1 < kRings) mesh.triangle(at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1));
    }
  return mesh.take();
}

}  // namespace ifov::landscape
