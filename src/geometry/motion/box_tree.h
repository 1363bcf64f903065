#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/world.h"
#include "math/ray.h"

namespace ifov::geometry {

/// Whether a ray comes, between its ends, as near as `beyond_m` to a box.
bool comes_near(const math::Ray& ray, const World::Bounds& box, double beyond_m);
/// How far a cone about a ray may reach aside where a box is.
double cone_reach_m(const math::Ray& ray, const World::Bounds& box, double spread_rad);

/// Boxes that a ray, or a cone about it, may meet, without a look at each of them: halved at the median along the longest side.
class BoxTree {
 public:
  explicit BoxTree(std::span<const World::Bounds> boxes);

  /// Calls at(number) for each box that may be met, in no order.
  template <class At>
  void visit(const math::Ray& ray, double spread_rad, const At& at) const {
    std::uint32_t waiting[kMostDeep];
    std::size_t count = 0;
    if (!nodes_.empty()) waiting[count++] = 0;
    while (count > 0) {
      const std::uint32_t n = waiting[--count];
      const Node& node = nodes_[n];
      if (!comes_near(ray, node.box, cone_reach_m(ray, node.box, spread_rad))) continue;
      if (node.number != kInner) {
        at(node.number);
        continue;
      }
      waiting[count++] = node.other;
      waiting[count++] = n + 1;
    }
  }

 private:
  static constexpr std::uint32_t kInner = ~std::uint32_t{0};
  static constexpr std::size_t kMostDeep = 64;  // halves of 2^32
  struct Node {
    World::Bounds box;
    std::uint32_t number = kInner;  ///< of its one box
    std::uint32_t other = 0;        ///< the second half; the first follows
  };
  void add(std::span<const World::Bounds> boxes, std::span<std::uint32_t> numbers);
  std::vector<Node> nodes_;
};

}  // namespace ifov::geometry
