#include "landscape/plants/leaf.h"

#include <algorithm>
#include <cmath>

namespace ifov::landscape {
namespace {

constexpr double kGoldenAngle_rad = 2.399963;

Vec3 any_direction(const RandomStream& random, int index) {
  const double z = random.between(-1.0, 1.0, index), angle = random.between(0.0, 2.0 * M_PI, index + 1);
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

int add_shoot(MeshBuilder& wood, MeshBuilder& leaves, const Foliage& foliage, Point3 base, Vec3 direction,
              int count, const RandomStream& random) {
  const double spacing = std::max(0.35 * foliage.leaf.length, 0.02), length = spacing * count;
  const Vec3 sag{0.0, 0.0, -foliage.droop};
  const Point3 middle = base + direction * (0.5 * length) + sag * (0.12 * length);
  const Point3 end = base + direction * length + sag * (0.5 * length);
  const Point3 axis[] = {base, middle, end};
  const double radii[] = {0.003, 0.0022, 0.0012};
  wood.tube(axis, radii, 3, false);
  const Vec3 across =
      math::normalized(math::cross(direction, std::abs(direction.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
  const Vec3 other = math::cross(direction, across);
  for (int k = 0; k < count; ++k) {
    const double t = (k + 0.5) / count, angle = kGoldenAngle_rad * k + random.between(0.0, 6.28, 0);
    const Point3 at =
        t < 0.5 ? base + (middle - base) * (2.0 * t) : middle + (end - middle) * (2.0 * t - 1.0);
    const Vec3 side = across * std::cos(angle) + other * std::sin(angle);
    const RandomStream draw = random.of(k);
    const Vec3 tip = math::normalized(side + direction * 0.6 + Vec3{0.0, 0.0, -0.15 - foliage.droop} +
                                      any_direction(draw, 0) * 0.35);
    const Vec3 face = math::normalized(Vec3{0.0, 0.0, 1.0} + any_direction(draw, 2) * 0.75);
    const double size = draw.between(0.75, 1.15, 4);
    add_leaf(leaves, {foliage.leaf.length * size, foliage.leaf.width * size, foliage.leaf.fold},
             at + tip * (0.2 * foliage.leaf.length), tip, face);
  }
  return count;
}

}  // namespace

void add_leaf(MeshBuilder& mesh, const Leaf& leaf, Point3 base, Vec3 tip, Vec3 face) {
  Vec3 side = math::cross(face, tip);
  if (math::length(side) < 1e-6) side = math::cross(Vec3{1.0, 0.0, 0.0}, tip);
  side = math::normalized(side);
  const Vec3 up = math::cross(tip, side);
  const Point3 middle = base + tip * (0.45 * leaf.length) + up * (0.5 * leaf.fold * leaf.width);
  const Point3 end = base + tip * leaf.length;
  mesh.quad(base, middle - side * (0.5 * leaf.width), end, middle + side * (0.5 * leaf.width));
}

void add_branches(MeshBuilder& mesh, const std::vector<Joint>& joints) {
  std::vector<int> thickest(joints.size(), -1);
  for (std::size_t k = 1; k < joints.size(); ++k) {
    int& heir = thickest[static_cast<std::size_t>(joints[k].parent)];
    if (heir < 0 || joints[k].tips > joints[static_cast<std::size_t>(heir)].tips) heir = static_cast<int>(k);
  }
  std::vector<Point3> axis;
  std::vector<double> radii;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const int parent = joints[k].parent;
    if (parent >= 0 && thickest[static_cast<std::size_t>(parent)] == static_cast<int>(k)) continue;
    axis.clear(), radii.clear();
    // A branch begins inside the one it grows from, as thick as itself.
    if (parent >= 0) {
      axis.push_back(joints[static_cast<std::size_t>(parent)].at);
      radii.push_back(joints[k].radius_m);
    }
    for (int j = static_cast<int>(k); j >= 0; j = thickest[static_cast<std::size_t>(j)]) {
      axis.push_back(joints[static_cast<std::size_t>(j)].at);
      radii.push_back(joints[static_cast<std::size_t>(j)].radius_m);
    }
    if (axis.size() < 2) continue;
    const double thick = radii.front();
    mesh.tube(axis, radii, thick > 0.06 ? 9 : thick > 0.015 ? 5 : 3, false);
  }
}

int add_foliage(MeshBuilder& wood, MeshBuilder& leaves, const std::vector<Joint>& joints,
                const Foliage& foliage, const RandomStream& random) {
  std::vector<std::size_t> twigs;
  for (std::size_t k = 1; k < joints.size(); ++k)
    if (joints[k].tips <= 3 && joints[k].at.z > foliage.lowest_m) twigs.push_back(k);
  int count = 0;
  for (std::size_t n = 0; n < twigs.size(); ++n) {
    // Leaves left over go to the twigs that are still to come, so that the total is as asked.
    const int share = static_cast<int>((foliage.count - count) / static_cast<int>(twigs.size() - n));
    const Joint& joint = joints[twigs[n]];
    const Vec3 along = math::normalized(joint.at - joints[static_cast<std::size_t>(joint.parent)].at);
    const int shoots = std::clamp(share / 8, 1, 4);
    for (int s = 0; s < shoots; ++s) {
      const RandomStream draw = random.of(static_cast<int>(twigs[n]), s, 3);
      const int size = s + 1 == shoots ? share - (shoots - 1) * (share / shoots) : share / shoots;
      if (size < 1) continue;
      const Vec3 direction = math::normalized(along * 0.5 + any_direction(draw, 0) + Vec3{0.0, 0.0, 0.25});
      count += add_shoot(wood, leaves, foliage, joint.at, direction, size, draw);
    }
  }
  return count;
}

}  // namespace ifov::landscape
