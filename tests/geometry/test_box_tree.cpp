#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "geometry/motion/box_tree.h"
#include "sampling/hash.h"
#include "sampling/random.h"

namespace ifov::test_box_tree {
namespace {

using geometry::BoxTree;
using geometry::World;

double number(std::uint64_t key, int k) { return 2.0 * sampling::unit_double(sampling::hash(key, k)) - 1.0; }

std::vector<World::Bounds> boxes_of(int count) {
  std::vector<World::Bounds> boxes;
  for (int n = 0; n < count; ++n) {
    const std::uint64_t key = sampling::hash(7, n);
    const math::Point3 low{20.0 * number(key, 0), 20.0 * number(key, 1), 5.0 * number(key, 2)};
    boxes.push_back(
        {low, low + 4.0 * math::Vec3{1.0 + number(key, 3), 1.0 + number(key, 4), 1.0 + number(key, 5)}});
  }
  // Two in one place.
  if (count > 1) boxes.back() = boxes.front();
  return boxes;
}

}  // namespace

TEST(BoxTree, FindsWhatALookAtEachBoxFinds) {
  std::size_t met = 0;
  for (const int count : {0, 1, 2, 3, 64, 301}) {
    const std::vector<World::Bounds> boxes = boxes_of(count);
    const BoxTree tree(boxes);
    for (int r = 0; r < 400; ++r) {
      const std::uint64_t key = sampling::hash(11, count, r);
      math::Ray ray;
      ray.origin_m = {25.0 * number(key, 0), 25.0 * number(key, 1), 8.0 * number(key, 2)};
      ray.direction = r % 7 == 0
                          ? math::Vec3{0.0, 0.0, -1.0}
                          : math::normalized(math::Vec3{number(key, 3), number(key, 4), number(key, 5)});
      ray.t_max_m = r % 3 == 0 ? 5.0 : 1e3;
      std::vector<std::uint32_t> found, each;
      tree.visit(ray, 0.0, [&](std::uint32_t n) { found.push_back(n); });
      for (std::uint32_t n = 0; n < boxes.size(); ++n)
        if (geometry::comes_near(ray, boxes[n], 0.0)) each.push_back(n);
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, each);
      met += each.size();
      // A cone meets whatever rays in it meet.
      constexpr double kSpread_rad = 0.05;
      std::vector<std::uint32_t> in_cone;
      tree.visit(ray, kSpread_rad, [&](std::uint32_t n) { in_cone.push_back(n); });
      math::Ray aside = ray;
      aside.direction = math::normalized(
          ray.direction + 0.99 * kSpread_rad * math::normalized(math::cross(ray.direction, {0.3, 0.5, 0.8})));
      for (std::uint32_t n = 0; n < boxes.size(); ++n)
        EXPECT_TRUE(!geometry::comes_near(aside, boxes[n], 0.0) ||
                    std::find(in_cone.begin(), in_cone.end(), n) != in_cone.end());
    }
  }
  EXPECT_GT(met, 500u);
}

}  // namespace ifov::test_box_tree
