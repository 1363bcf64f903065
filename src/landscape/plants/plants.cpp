#include "landscape/plants/plants.h"

#include <cmath>

#include "core/format.h"

namespace ifov::landscape {

Stock add_plant(const std::string& name, const Tree& plant, bool low_branches,
                const std::string& leaf_material, const std::string& bark_material, SceneFolder& folder,
                SceneMaker& scene) {
  const std::string wood = folder.add_large_mesh(name + "_wood", plant.wood);
  const std::string leaves = folder.add_large_mesh(name + "_leaves", plant.leaves);
  scene.prototype(name, {mesh_object("", wood, scene.only(bark_material)),
                         mesh_object("", leaves, scene.only(leaf_material))});
  return {name, plant.crown_radius_m, low_branches, {}};
}

std::vector<Stock> add_trees(int individuals, const RandomStream& random, SceneFolder& folder,
                             SceneMaker& scene, std::vector<int>* leaf_counts) {
  std::vector<Stock> stocks;
  int number = 0;
  for (const Species& species : tree_species())
    for (int k = 0; k < individuals; ++k) {
      const Tree tree =
          grow_tree(species, sampling::hash(std::uint64_t{17}, random.of(++number).pick(1 << 30, 0)));
      if (leaf_counts != nullptr) leaf_counts->push_back(tree.leaf_count);
      const std::string name(species.name);
      stocks.push_back(add_plant(format("{}_{}", name, k + 1), tree, species.low_branches, "leaf, " + name,
                                 name == "birch" ? "bark, birch" : "bark", folder, scene));
    }
  return stocks;
}

void place_plants(const std::vector<Stock>& stocks, const std::function<double(Vec2)>& ground_m,
                  SceneFolder& folder, SceneMaker& scene) {
  for (const Stock& stock : stocks) {
    if (stock.copies.empty()) continue;
    std::string rows = "# x, y, z (m), rotation about z (degrees), scale\n";
    for (const Planted& plant : stock.copies)
      rows += format("{:.3f},{:.3f},{:.3f},{:.2f},{:.4f}\n", plant.at.x, plant.at.y, ground_m(plant.at),
                     plant.rotation_rad * 180.0 / M_PI, plant.scale);
    const std::string file = folder.add_list(stock.prototype, rows);
    io::ObjectDocument object;
    object.name = stock.prototype;
    object.shape = io::InstancesShape{{stock.prototype, {}}, {}, io::DocumentFile{file, {}}, {}};
    scene.object(std::move(object));
  }
}

}  // namespace ifov::landscape
