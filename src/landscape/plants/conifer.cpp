#include "landscape/plants/conifer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "landscape/plants/leaf.h"

namespace ifov::landscape {
namespace {

constexpr Leaf kShoot{0.1, 0.022, 0.0};
constexpr double kShootSpacing_m = 0.034;

/// Shoots on both sides of a branchlet, and one at its end.
int add_shoots(MeshBuilder& leaves, Point3 from, Vec3 direction, double length_m,
               const RandomStream& random) {
  const Vec3 side = math::normalized(math::cross(direction, Vec3{0.0, 0.0, 1.0}));
  int count = 0;
  for (double t = 0.02; t < length_m; t += kShootSpacing_m, ++count) {
    const RandomStream draw = random.of(count);
    const Vec3 tip = math::normalized(direction * 0.75 + side * (count % 2 == 0 ? 0.8 : -0.8) +
                                      Vec3{0.0, 0.0, draw.between(-0.25, 0.45, 0)});
    add_leaf(leaves, kShoot, from + direction * t, tip,
             {draw.between(-0.5, 0.5, 1), draw.between(-0.5, 0.5, 2), 1.0});
  }
  return count;
}

int add_branch(MeshBuilder& wood, MeshBuilder& leaves, double z, double angle, double length_m, double dip,
               const RandomStream& random) {
  // Down from the stem, and up again towards the end.
  std::vector<Point3> axis;
  std::vector<double> radii;
  const Vec3 out{std::cos(angle), std::sin(angle), 0.0};
  constexpr int kPoints = 7;
  for (int k = 0; k < kPoints; ++k) {
    const double t = static_cast<double>(k) / (kPoints - 1);
    axis.push_back(Point3{0.0, 0.0, z} + out * (t * length_m) +
                   Vec3{0.0, 0.0, length_m * (-dip * t + 0.75 * dip * t * t)});
    radii.push_back((0.006 + 0.007 * length_m) * (1.0 - 0.85 * t));
  }
  wood.tube(axis, radii, 4, false);
  int count = 0;
  const double spacing = 0.105;
  int number = 0;
  for (double along = 0.12 * length_m; along < length_m; along += spacing, ++number) {
    const double t = along / length_m * (kPoints - 1);
    const auto k = std::min(static_cast<std::size_t>(t), std::size_t{kPoints - 2});
    const Vec3 direction = math::normalized(axis[k + 1] - axis[k]);
    const Point3 at = axis[k] + (axis[k + 1] - axis[k]) * (t - static_cast<double>(k));
    const Vec3 side = math::normalized(math::cross(direction, Vec3{0.0, 0.0, 1.0}));
    for (const double hand : {-1.0, 1.0}) {
      const RandomStream draw = random.of(number, hand > 0.0);
      const double reach = std::min(0.42, 0.08 + 0.6 * (length_m - along)) * draw.between(0.75, 1.1, 0);
      const Vec3 towards =
          math::normalized(direction * 0.75 + side * hand + Vec3{0.0, 0.0, draw.between(-0.3, 0.1, 1)});
      wood.tube(std::array{at, at + towards * reach}, std::array{0.003, 0.0015}, 3, false);
      count += add_shoots(leaves, at, towards, reach, draw.of(1));
    }
    count += add_shoots(leaves, at, direction, spacing, random.of(number, 2));
  }
  return count;
}

}  // namespace

Tree grow_conifer(const Species& species, const RandomStream& random) {
  const double height = species.height_m * random.between(0.85, 1.15, 0);
  const double radius = species.crown_radius_m * random.between(0.85, 1.0, 1);
  Tree tree;
  MeshBuilder wood, leaves;
  wood.slot("wood");
  leaves.slot("leaf");
  std::vector<Point3> stem;
  std::vector<double> radii;
  for (int k = 0; k <= 16; ++k) {
    const double t = k / 16.0, z = -0.3 + t * (height + 0.25);
    stem.push_back({0.0, 0.0, z});
    radii.push_back((0.012 * height) * (1.0 - 0.97 * t) * (1.0 + 0.45 * std::exp(-std::max(z, 0.0) / 0.25)));
  }
  wood.tube(stem, radii, 9, false);
  int whorl = 0;
  for (double z = 0.09 * height; z < 0.985 * height; z += 0.36, ++whorl) {
    const RandomStream at = random.of(whorl, 5);
    const double t = (z - 0.09 * height) / (0.91 * height);
    const int branches = t > 0.85 ? 5 : 7;
    for (int k = 0; k < branches; ++k) {
      const RandomStream draw = at.of(k);
      const double length = std::max(0.12, radius * std::pow(1.0 - t, 0.85)) * draw.between(0.78, 1.0, 0);
      const double angle = 2.0 * M_PI * (k + draw.between(-0.3, 0.3, 1)) / branches + 1.7 * whorl;
      const double dip = 0.55 * (1.0 - t) - 0.35 * t;
      tree.leaf_count += add_branch(wood, leaves, z + draw.between(-0.12, 0.12, 2), angle, length, dip, draw);
    }
  }
  tree.leaf_count += add_shoots(leaves, {0.0, 0.0, 0.96 * height}, math::normalized(Vec3{0.05, 0.0, 1.0}),
                                0.04 * height, random.of(99));
  tree.wood = wood.take();
  tree.leaves = leaves.take();
  return tree;
}

}  // namespace ifov::landscape
