#include "geometry/motion/box_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ifov::geometry {

bool comes_near(const math::Ray& ray, const World::Bounds& box, double beyond_m) {
  double first = ray.t_min_m, last = ray.t_max_m;
  const double origin[3] = {ray.origin_m.x, ray.origin_m.y, ray.origin_m.z},
               direction[3] = {ray.direction.x, ray.direction.y, ray.direction.z},
               low[3] = {box.low_m.x, box.low_m.y, box.low_m.z},
               high[3] = {box.high_m.x, box.high_m.y, box.high_m.z};
  for (int a = 0; a < 3; ++a) {
    const double l = low[a] - beyond_m, h = high[a] + beyond_m;
    if (direction[a] == 0.0) {
      if (origin[a] < l || origin[a] > h) return false;
      continue;
    }
    const double one = (l - origin[a]) / direction[a], other = (h - origin[a]) / direction[a];
    first = std::max(first, std::min(one, other)), last = std::min(last, std::max(one, other));
    if (!(first <= last)) return false;
  }
  return true;
}

double cone_reach_m(const math::Ray& ray, const World::Bounds& box, double spread_rad) {
  if (spread_rad == 0.0) return 0.0;
  const math::Vec3 diagonal = box.high_m - box.low_m;
  const math::Point3 middle = box.low_m + 0.5 * diagonal;
  return std::tan(std::min(spread_rad, 1.5)) *
         (math::length(middle - ray.origin_m) + 0.5 * math::length(diagonal));
}

BoxTree::BoxTree(std::span<const World::Bounds> boxes) {
  std::vector<std::uint32_t> numbers(boxes.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  if (!numbers.empty()) add(boxes, numbers);
}

void BoxTree::add(std::span<const World::Bounds> boxes, std::span<std::uint32_t> numbers) {
  const std::size_t at = nodes_.size();
  World::Bounds all = boxes[numbers[0]];
  for (const std::uint32_t k : numbers) {
    all.low_m = {std::min(all.low_m.x, boxes[k].low_m.x), std::min(all.low_m.y, boxes[k].low_m.y),
                 std::min(all.low_m.z, boxes[k].low_m.z)};
    all.high_m = {std::max(all.high_m.x, boxes[k].high_m.x), std::max(all.high_m.y, boxes[k].high_m.y),
                  std::max(all.high_m.z, boxes[k].high_m.z)};
  }
  nodes_.push_back({all, numbers.size() == 1 ? numbers[0] : kInner, 0});
  if (numbers.size() == 1) return;
  const math::Vec3 side = all.high_m - all.low_m;
  const auto middle = [&](std::uint32_t k) {
    const math::Point3 low = boxes[k].low_m, high = boxes[k].high_m;
    return side.x >= side.y && side.x >= side.z ? low.x + high.x
           : side.y >= side.z                   ? low.y + high.y
                                                : low.z + high.z;
  };
  const std::size_t half = numbers.size() / 2;
  std::nth_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(half), numbers.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return middle(a) != middle(b) ? middle(a) < middle(b) : a < b;
                   });
  add(boxes, numbers.first(half));
  nodes_[at].other = static_cast<std::uint32_t>(nodes_.size());
  add(boxes, numbers.subspan(half));
}

}  // namespace ifov::geometry
