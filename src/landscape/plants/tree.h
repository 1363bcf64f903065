#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "geometry/triangle_mesh.h"

namespace ifov::landscape {

/// A tree: wood, and leaves one by one. Slots: wood, leaf.
struct Tree {
  geometry::TriangleMesh wood, leaves;
  int leaf_count = 0;
  double height_m = 0.0, crown_radius_m = 0.0;
};

/// What grows: a broadleaved species, a conifer (its leaves are shoots of needles), or a shrub.
struct Species {
  std::string_view name;  ///< of the prototypes and of the leaf's material
  std::string_view summary;
  double height_m, crown_radius_m;  ///< of a usual tree; individuals differ
  bool low_branches;                ///< nothing stands under its crown
};

/// Oak, maple, birch, spruce.
std::span<const Species> tree_species();

/// An individual of a species: 20,000 to 100,000 leaves.
Tree grow_tree(const Species& species, std::uint64_t seed);

}  // namespace ifov::landscape
