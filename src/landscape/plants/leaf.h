#pragma once

#include <vector>

#include "landscape/plants/tree_skeleton.h"
#include "landscape/shapes/mesh_builder.h"
#include "landscape/shapes/random_stream.h"

namespace ifov::landscape {

/// A leaf: a rhombus folded along its midrib.
struct Leaf {
  double length = 0.1, width = 0.06;
  double fold = 0.3;  ///< rise of its sides over half its width
};

/// From its base along `tip`; `face` is about where its upper side looks.
void add_leaf(MeshBuilder& mesh, const Leaf& leaf, Point3 base_m, Vec3 tip, Vec3 face);

/// Tubes along all branches, each continued by its thickest child.
void add_branches(MeshBuilder& mesh, const std::vector<Joint>& joints);

struct Foliage {
  Leaf leaf;
  int count = 40000;
  double droop = 0.0;
  double lowest_m = 0.0;  ///< no leaves below
};

/// Shoots with leaves in spirals on all twigs: about `count` leaves, the number of which is returned.
int add_foliage(MeshBuilder& wood, MeshBuilder& leaves, const std::vector<Joint>& joints,
                const Foliage& foliage, const RandomStream& random);

}  // namespace ifov::landscape
