#include "landscape/plants/bush.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "landscape/plants/leaf.h"

namespace ifov::landscape {
namespace {

Vec3 leaf_face(const RandomStream& draw) {
  return math::normalized(Vec3{draw.between(-0.8, 0.8, 20), draw.between(-0.8, 0.8, 21), 1.0});
}

Vec3 leaf_tip(const RandomStream& draw, Vec3 outward) {
  return math::normalized(
      outward + Vec3{draw.between(-0.7, 0.7, 22), draw.between(-0.7, 0.7, 23), draw.between(-0.4, 0.6, 24)});
}

}  // namespace

Tree grow_hedge(const RandomStream& random) {
  Tree hedge;
  MeshBuilder wood, leaves;
  wood.slot("wood");
  leaves.slot("leaf");
  const double half_width = kHedge_half_width_m - 0.06, top = kHedge_height_m - 0.06;
  for (int k = 0; k < 4; ++k) {
    const RandomStream draw = random.of(1, k);
    const double x = -0.375 + 0.25 * k, lean = draw.between(-0.2, 0.2, 0);
    wood.tube(
        std::array<Point3, 3>{
            {{x, 0.0, -0.05}, {x + 0.3 * lean, lean * 0.4, 0.5}, {x + 0.5 * lean, lean, 0.9 * top}}},
        std::array{0.022, 0.016, 0.006}, 5, false);
    for (int b = 0; b < 8; ++b) {
      const RandomStream side = draw.of(b);
      const double z = 0.15 + 0.12 * b, angle = side.between(0.0, 2.0 * M_PI, 0);
      const Point3 from{x + lean * 0.4 * z, lean * 0.6 * z, z};
      wood.tube(from, from + Vec3{0.2 * std::cos(angle), half_width * 0.85 * std::sin(angle), 0.16}, 0.004,
                3);
    }
  }
  constexpr int kLeaves = 4600;
  for (int k = 0; k < kLeaves; ++k) {
    const RandomStream draw = random.of(2, k);
    // Most leaves are near the faces that the shears reach.
    const double depth = draw.happens(0.75, 0) ? 0.14 * draw.unit(1) : 0.5 * draw.unit(1);
    double x = draw.between(-0.54, 0.54, 2), y = draw.between(-half_width, half_width, 3),
           z = draw.between(0.12, top, 4);
    Vec3 outward{0.0, 0.0, 1.0};
    if (draw.happens(half_width / (half_width + top), 5)) {
      z = top - depth;
    } else {
      const double side = draw.happens(0.5, 6) ? 1.0 : -1.0;
      y = side * (half_width - std::min(depth, half_width));
      outward = {0.0, side, 0.3};
    }
    add_leaf(leaves, {0.055, 0.032, 0.2}, {x, y, z}, leaf_tip(draw, outward), leaf_face(draw));
  }
  hedge.leaf_count = kLeaves;
  hedge.height_m = kHedge_height_m;
  hedge.crown_radius_m = kHedge_half_width_m;
  hedge.wood = wood.take();
  hedge.leaves = leaves.take();
  return hedge;
}

Tree grow_shrub(double radius, double height, int leaf_count, double leaf_length,
                const RandomStream& random) {
  Tree shrub;
  MeshBuilder wood, leaves;
  wood.slot("wood");
  leaves.slot("leaf");
  constexpr int kStems = 26;
  for (int k = 0; k < kStems; ++k) {
    const RandomStream draw = random.of(1, k);
    const double angle = 2.4 * k, reach = radius * std::sqrt((k + 0.5) / kStems) * draw.between(0.75, 1.0, 0);
    const double up = height * std::sqrt(std::max(0.08, 1.0 - 0.85 * reach * reach / (radius * radius))) *
                      draw.between(0.8, 1.0, 1);
    const Vec3 out{std::cos(angle), std::sin(angle), 0.0};
    const Point3 foot = Point3{0, 0, -0.03} + out * (0.12 * reach);
    const Point3 middle = Point3{0, 0, 0.5 * up} + out * (0.45 * reach),
                 end = Point3{0, 0, up} + out * (0.95 * reach);
    wood.tube(std::array{foot, middle, end}, std::array{0.012, 0.008, 0.003}, 4, false);
    const int share = leaf_count / kStems;
    for (int n = 0; n < share; ++n) {
      const RandomStream leaf = draw.of(n);
      const double t = std::sqrt(leaf.between(0.06, 1.0, 0));
      const Point3 at =
          t < 0.5 ? foot + (middle - foot) * (2.0 * t) : middle + (end - middle) * (2.0 * t - 1.0);
      const double spread = 0.22 * radius;
      const Vec3 off{leaf.between(-spread, spread, 1), leaf.between(-spread, spread, 2),
                     leaf.between(-spread, spread, 3)};
      Point3 base = at + off;
      base.z = std::max(base.z, 0.08);
      add_leaf(leaves, {leaf_length, 0.5 * leaf_length, 0.2}, base, leaf_tip(leaf, out), leaf_face(leaf));
      ++shrub.leaf_count;
    }
  }
  shrub.height_m = height;
  shrub.crown_radius_m = 1.15 * radius;
  shrub.wood = wood.take();
  shrub.leaves = leaves.take();
  return shrub;
}

}  // namespace ifov::landscape
