#include "landscape/terrain/terrain.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"

namespace ifov::landscape {
namespace {

constexpr int kMost_cells = 4400;

int steps_of(const Terrain& terrain) {
  return static_cast<int>(std::lround(2.0 * terrain.half_m / terrain.mesh_m));
}

}  // namespace

double Terrain::on_mesh_m(Vec2 at) const {
  const int steps = steps_of(*this);
  const double cell = 2.0 * half_m / steps;
  const double x = std::clamp((at.x + half_m) / cell, 0.0, steps - 1e-9),
               y = std::clamp((at.y + half_m) / cell, 0.0, steps - 1e-9);
  const double column = std::floor(x), row = std::floor(y), u = x - column, v = y - row;
  const auto node = [&](double c, double r) { return height_m({-half_m + c * cell, -half_m + r * cell}); };
  const double low = node(column, row), high = node(column + 1.0, row + 1.0);
  // Cells are halved along the diagonal from low to high.
  if (u > v) {
    const double side = node(column + 1.0, row);
    return low + u * (side - low) + v * (high - side);
  }
  const double side = node(column, row + 1.0);
  return low + v * (side - low) + u * (high - side);
}

void add_terrain(const Terrain& terrain, SceneFolder& folder, SceneMaker& scene) {
  const int steps = steps_of(terrain);
  const double cell = 2.0 * terrain.half_m / steps;
  geometry::TriangleMesh mesh;
  for (int row = 0; row <= steps; ++row)
    for (int column = 0; column <= steps; ++column) {
      const Vec2 at{-terrain.half_m + column * cell, -terrain.half_m + row * cell};
      mesh.vertices_m.push_back({at.x, at.y, terrain.height_m(at)});
    }
  const auto index = [&](int column, int row) {
    return static_cast<std::uint32_t>(row * (steps + 1) + column);
  };
  for (int row = 0; row < steps; ++row)
    for (int column = 0; column < steps; ++column) {
      mesh.triangles.push_back({index(column, row), index(column + 1, row), index(column + 1, row + 1)});
      mesh.triangles.push_back({index(column, row), index(column + 1, row + 1), index(column, row + 1)});
    }
  const std::string mesh_file = folder.add_large_mesh("terrain", mesh);

  io::Raster raster;
  const double size = 2.0 * terrain.half_m;
  raster.width = raster.height = std::min(kMost_cells, static_cast<int>(std::ceil(size / terrain.map_m)));
  raster.bands = 1;
  const double map_cell = size / raster.width;
  raster.geotransform = {-terrain.half_m, map_cell, 0.0, terrain.half_m, 0.0, -map_cell};
  for (int row = 0; row < raster.height; ++row)
    for (int column = 0; column < raster.width; ++column)
      raster.values.push_back(static_cast<float>(terrain.cover(
          {-terrain.half_m + (column + 0.5) * map_cell, terrain.half_m - (row + 0.5) * map_cell})));
  const std::string map_file = folder.add_map("ground_cover", raster);
  scene.object(mesh_object("ground", mesh_file, scene.classes(map_file, terrain.half_m, terrain.covers)));
}

}  // namespace ifov::landscape
