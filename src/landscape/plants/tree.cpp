#include "landscape/plants/tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "landscape/plants/conifer.h"
#include "landscape/plants/leaf.h"
#include "landscape/plants/tree_skeleton.h"

namespace ifov::landscape {
namespace {

/// What tells broadleaved species apart beyond size.
struct Habit {
  double base_share;  ///< height of the crown's base as a share of the tree's
  double widest, upper,
      lower;                  ///< relative height of the widest place; how quickly it narrows above and below
  double trunk_radius_share;  ///< of the height
  int attractors;
  Leaf leaf;
  int leaf_count;
  double droop;  ///< downward bend of shoots
};

constexpr std::array kSpecies{
    Species{"oak", "a broad crown, leaves of 11 x 6 cm", 11.0, 4.4, false},
    Species{"maple", "an oval crown, leaves of 12 x 11 cm", 9.5, 3.2, false},
    Species{"birch", "a slender, drooping crown, leaves of 6 x 4.5 cm", 12.0, 2.6, false},
    Species{"spruce", "a cone of whorled branches; leaves are shoots of needles, 10 x 2.2 cm", 13.0, 2.7,
            true},
};

Habit habit_of(std::string_view name) {
  if (name == "oak") return {0.24, 0.42, 2.0, 2.0, 0.024, 1500, {0.115, 0.065, 0.3}, 52000, 0.0};
  if (name == "maple") return {0.22, 0.38, 1.7, 2.0, 0.019, 1250, {0.12, 0.11, 0.25}, 34000, 0.05};
  return {0.2, 0.35, 1.25, 1.7, 0.012, 1100, {0.062, 0.045, 0.2}, 64000, 0.55};
}

/// 1 at the widest place, 0 at the top, half at the base.
double profile(const Habit& habit, double t) {
  if (t > habit.widest) {
    const double s = (t - habit.widest) / (1.0 - habit.widest);
    return std::sqrt(std::max(0.0, 1.0 - std::pow(s, habit.upper)));
  }
  const double s = (habit.widest - t) / habit.widest;
  return std::sqrt(std::max(0.0, 1.0 - 0.8 * std::pow(s, habit.lower)));
}

Tree grow_broadleaf(const Species& species, const RandomStream& random) {
  const Habit habit = habit_of(species.name);
  const double size = random.between(0.88, 1.12, 0);
  CrownShape crown;
  crown.height = species.height_m * size;
  crown.base = crown.height * habit.base_share;
  crown.radius = species.crown_radius_m * size * random.between(0.94, 1.06, 1) * 0.92;
  crown.profile = [&](double t) { return profile(habit, t); };
  crown.trunk_radius = habit.trunk_radius_share * crown.height;
  crown.attractors = habit.attractors;
  const std::vector<Joint> joints = grow_skeleton(crown, random);

  Tree tree;
  MeshBuilder wood;
  wood.slot("wood");
  add_branches(wood, joints);
  MeshBuilder leaves;
  leaves.slot("leaf");
  const int wanted = static_cast<int>(habit.leaf_count * random.between(0.92, 1.08, 2));
  tree.leaf_count =
      add_foliage(wood, leaves, joints, {habit.leaf, wanted, habit.droop, 0.7 * crown.base}, random);
  tree.wood = wood.take();
  tree.leaves = leaves.take();
  return tree;
}

}  // namespace

std::span<const Species> tree_species() { return kSpecies; }

Tree grow_tree(const Species& species, std::uint64_t seed) {
  const RandomStream random(seed);
  Tree tree = species.name == "spruce" ? grow_conifer(species, random) : grow_broadleaf(species, random);
  for (const geometry::TriangleMesh* part : {&tree.wood, &tree.leaves})
    for (const math::Point3& p : part->vertices_m) {
      tree.height_m = std::max(tree.height_m, p.z);
      tree.crown_radius_m = std::max(tree.crown_radius_m, std::hypot(p.x, p.y));
    }
  return tree;
}

}  // namespace ifov::landscape
