#include "landscape/plants/tree_skeleton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ifov::landscape {
namespace {

enum class Draw { attractor, trunk };

std::vector<Point3> scatter_attractors(const CrownShape& crown, const RandomStream& random) {
  std::vector<Point3> points;
  const RandomStream clumps = random.of(7);
  for (int k = 0; static_cast<int>(points.size()) < crown.attractors; ++k) {
    const RandomStream draw = random.of(Draw::attractor, k);
    const double t = draw.unit(0), x = draw.between(-1.0, 1.0, 1), y = draw.between(-1.0, 1.0, 2);
    const double r = std::hypot(x, y), limit = crown.profile(t);
    if (r > limit) continue;
    // Clumps with gaps between them, and more leaves towards the outside, as light has it.
    const double angle = std::atan2(y, x);
    const double clump =
        fractal_noise(clumps, 2.2 * std::cos(angle) * r + 9.0, 2.2 * std::sin(angle) * r + 5.0 * t, 0.8, 2);
    const double outside = limit > 0.0 ? r / limit : 1.0;
    if (draw.unit(3) > (0.25 + 0.75 * outside * outside) * std::clamp(2.6 * clump - 0.55, 0.0, 1.0)) continue;
    points.push_back({x * crown.radius, y * crown.radius, crown.base + t * (crown.height - crown.base)});
  }
  return points;
}

/// The trunk up to two thirds of the crown, with a slight sweep.
std::vector<Joint> raise_trunk(const CrownShape& crown, double step, const RandomStream& random) {
  std::vector<Joint> joints{{{0.0, 0.0, -0.3}, -1, 0.0, 0}};
  const RandomStream draw = random.of(Draw::trunk);
  const double top = crown.base + 0.55 * (crown.height - crown.base);
  const double lean = draw.between(0.0, 0.06, 0), towards = draw.between(0.0, 2.0 * M_PI, 1);
  for (double z = -0.3 + step; z < top; z += step) {
    const double sweep = lean * (std::max(z, 0.0) + 0.4 * std::sin(1.3 * z));
    joints.push_back({{sweep * std::cos(towards), sweep * std::sin(towards), z},
                      static_cast<int>(joints.size()) - 1,
                      0.0,
                      0});
  }
  return joints;
}

}  // namespace

void set_radii(std::vector<Joint>& joints, double trunk_radius_m, double tip_radius_m) {
  for (Joint& joint : joints) joint.tips = 0;
  std::vector<bool> has_child(joints.size(), false);
  for (const Joint& joint : joints)
    if (joint.parent >= 0) has_child[static_cast<std::size_t>(joint.parent)] = true;
  for (std::size_t k = joints.size(); k-- > 0;) {
    if (!has_child[k]) joints[k].tips = 1;
    if (joints[k].parent >= 0) joints[static_cast<std::size_t>(joints[k].parent)].tips += joints[k].tips;
  }
  const double power = std::log(trunk_radius_m / tip_radius_m) / std::log(std::max(2, joints.front().tips));
  for (Joint& joint : joints) {
    joint.radius_m = tip_radius_m * std::pow(joint.tips, power);
    // The foot of the trunk flares out.
    if (joint.tips == joints.front().tips)
      joint.radius_m *= 1.0 + 0.5 * std::exp(-std::max(joint.at.z, 0.0) / 0.25);
  }
}

std::vector<Joint> grow_skeleton(const CrownShape& crown, const RandomStream& random) {
  const double step = 0.22 * std::sqrt(crown.radius / 3.5), reach = 20.0 * step, kill = 1.6 * step;
  const std::vector<Point3> attractors = scatter_attractors(crown, random);
  std::vector<Joint> joints = raise_trunk(crown, step, random);

  struct Pull {
    int nearest = -1;
    double distance = std::numeric_limits<double>::infinity();
  };
  std::vector<Pull> pulls(attractors.size());
  std::vector<bool> reached(attractors.size(), false);
  std::size_t looked_at = 0;
  for (int round = 0; round < 400; ++round) {
    for (; looked_at < joints.size(); ++looked_at) {
      if (joints[looked_at].at.z < 0.7 * crown.base) continue;
      for (std::size_t a = 0; a < attractors.size(); ++a) {
        const double d = math::length(attractors[a] - joints[looked_at].at);
        if (d < pulls[a].distance) pulls[a] = {static_cast<int>(looked_at), d};
        if (d < kill) reached[a] = true;
      }
    }
    std::vector<Vec3> direction(joints.size());
    for (std::size_t a = 0; a < attractors.size(); ++a) {
      if (reached[a] || pulls[a].nearest < 0 || (round > 12 && pulls[a].distance > reach)) continue;
      const auto joint = static_cast<std::size_t>(pulls[a].nearest);
      direction[joint] = direction[joint] + math::normalized(attractors[a] - joints[joint].at);
    }
    const std::size_t count = joints.size();
    for (std::size_t k = 0; k < count; ++k) {
      if (math::length(direction[k]) < 1e-6) continue;
      // Branches bend upwards a little, and jitter keeps two pulls from holding each other up.
      const RandomStream jitter = random.of(round, static_cast<int>(k));
      const Vec3 bend{jitter.between(-0.18, 0.18, 0), jitter.between(-0.18, 0.18, 1),
                      jitter.between(-0.05, 0.2, 2)};
      const Vec3 grow = math::normalized(math::normalized(direction[k]) + bend);
      joints.push_back({joints[k].at + grow * step, static_cast<int>(k), 0.0, 0});
    }
    if (joints.size() == count || joints.size() > 12000) break;
  }
  set_radii(joints, crown.trunk_radius, 0.004);
  return joints;
}

}  // namespace ifov::landscape
