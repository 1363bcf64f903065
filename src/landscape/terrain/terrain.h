#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "landscape/output/scene_folder.h"
#include "landscape/output/scene_maker.h"
#include "landscape/shapes/plane.h"

namespace ifov::landscape {

/// Ground without streets: a surface over a square, and what covers it.
struct Terrain {
  double half_m = 0.0;
  std::function<double(Vec2)> height_m;
  /// Number of the cover, counted from 1, in `covers`.
  std::function<int(Vec2)> cover;
  std::vector<std::string> covers;    ///< materials
  double mesh_m = 2.0, map_m = 0.25;  ///< spacing of the heights, cell of the map

  /// On the facets of the mesh, where things stand.
  double on_mesh_m(Vec2 at) const;
};

/// Writes the terrain's mesh and map, and names them in the document.
void add_terrain(const Terrain& terrain, SceneFolder& folder, SceneMaker& scene);

}  // namespace ifov::landscape
