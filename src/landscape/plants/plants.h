#pragma once

#include <functional>
#include <string>
#include <vector>

#include "landscape/output/scene_folder.h"
#include "landscape/output/scene_maker.h"
#include "landscape/plants/tree.h"
#include "landscape/plots/garden_plan.h"

namespace ifov::landscape {

/// Writes a plant's meshes and its prototype, and returns it as stock without copies.
Stock add_plant(const std::string& name, const Tree& plant, bool low_branches,
                const std::string& leaf_material, const std::string& bark_material, SceneFolder& folder,
                SceneMaker& scene);

/// All individuals of all tree species: `individuals` of each, named "oak_1", ...
std::vector<Stock> add_trees(int individuals, const RandomStream& random, SceneFolder& folder,
                             SceneMaker& scene, std::vector<int>* leaf_counts);

/// Writes the copies of each stock as an instance list and names it in the document. Copies stand on the ground whose
/// height is given.
void place_plants(const std::vector<Stock>& stocks, const std::function<double(Vec2)>& ground_m,
                  SceneFolder& folder, SceneMaker& scene);

}  // namespace ifov::landscape
