#include "sampling/image/pixel_points.h"

#include <array>
#include <numeric>
#include <utility>

#include "sampling/footprint_groups.h"
#include "sampling/hash.h"
#include "sampling/pixel_footprint.h"
#include "sampling/random.h"
#include "sampling/sub_element_lattice.h"
#include "sampling/tile.h"

namespace ifov::sampling {

namespace {

enum class Draw : std::uint64_t { across, down, first_four, of_four, column, row, again };

/// Where all of a footprint lies in bright places what is drawn beside them counts for nothing.
constexpr std::uint64_t kMostTries = 1024;

FocalPoint point_at(const PixelFootprint& footprint, int i, int j, Point2 u) {
  const double side = 2.0 * footprint.half_width_px();
  const Point2 about =
      footprint.uniform() ? Point2{(u.x - 0.5) * side, (u.y - 0.5) * side} : footprint_point(footprint, u);
  return {i + 0.5 + about.x, j + 0.5 + about.y};
}

/// Which of the `count` slots of a line each of its cells takes: a permutation (Fisher and Yates).
void permute(std::uint64_t key, std::size_t count, int* slots) {
  std::iota(slots, slots + count, 0);
  for (std::size_t k = count; k > 1; --k) std::swap(slots[k - 1], slots[hash(key, k) % k]);
}

}  // namespace

void PixelPoints::clear() {
  requests.clear();
  whole.clear();
  counts.clear();
  importance.clear();
}

void PixelPoints::add(const TileProblem& problem, const BrightShares& bright, int i, int j, std::uint64_t key,
                      const PixelPlan& plan) {
  const FootprintGroups* const groups = problem.groups;
  const PixelFootprint& footprint = groups == nullptr ? *problem.footprint : groups->mixture();
  const std::size_t first = requests.size();
  add(footprint, i, j, key, plan);
  // What lies in a bright place is drawn anew until it does not: points then lie as densely beside such places as the footprint has it.
  for (std::size_t k = first; k < requests.size() && !bright.parts.empty(); ++k) {
    FocalPoint point = requests[k].point;
    for (std::uint64_t n = 0; n < kMostTries && bright.hold(point); ++n) {
      const std::uint64_t again = hash(key, Draw::again, k - first, n);
      point = point_at(footprint, i, j, {unit_double(again), unit_double(again + 1)});
    }
    requests[k].point = point;
  }
  add_importance(problem, i, j, plan);
}

void PixelPoints::add(const TileProblem& problem, const BrightPlaces::Rectangle& where, int i, int j,
                      std::uint64_t key, const PixelPlan& plan) {
  const FootprintGroups* const groups = problem.groups;
  const BrightWarp warp(groups == nullptr ? *problem.footprint : groups->mixture(), where, i, j);
  add_points(key, plan, [&](Point2 u, std::uint64_t k) { return warp.at(u, hash(key, Draw::again, k)); });
  add_importance(problem, i, j, plan);
}

void PixelPoints::add(const PixelFootprint& footprint, int i, int j, std::uint64_t key,
                      const PixelPlan& plan) {
  add_points(key, plan, [&](Point2 u, std::uint64_t) { return point_at(footprint, i, j, u); });
}

void PixelPoints::add_importance(const TileProblem& problem, int i, int j, const PixelPlan& plan) {
  const FootprintGroups* const groups = problem.groups;
  if (groups == nullptr) return;
  for (std::size_t k = requests.size() - plan.count(); k < requests.size(); ++k)
    for (std::size_t g = 0; g < groups->size(); ++g)
      importance.push_back(static_cast<float>(
          groups->importance(g, i, requests[k].point.x_px - i - 0.5, requests[k].point.y_px - j - 0.5)));
}

template <class PlaceOf>
void PixelPoints::add_points(std::uint64_t key, const PixelPlan& plan, const PlaceOf& place) {
  const std::uint32_t count = plan.count(), fours = count / 4;
  const std::uint64_t start = hash(key, Draw::first_four) % fours;
  const auto columns = static_cast<std::size_t>(plan.across), rows = static_cast<std::size_t>(plan.down);
  across_.resize(count);
  down_.resize(count);
  for (std::size_t a = 0; a < columns; ++a) permute(hash(key, Draw::column, a), rows, &across_[a * rows]);
  for (std::size_t b = 0; b < rows; ++b) permute(hash(key, Draw::row, b), columns, &down_[b * columns]);
  std::uint32_t followed = 0, others = plan.whole;
  for (std::uint32_t four = 0; four < fours; ++four) {
    const int a = 2 * static_cast<int>(four % static_cast<std::uint32_t>(plan.across / 2)),
              b = 2 * static_cast<int>(four / static_cast<std::uint32_t>(plan.across / 2));
    // Systematic sampling: as many of each four as come to whole numbers along the way.
    const std::uint64_t before = (std::uint64_t{four} * plan.whole + start) / fours,
                        after = (std::uint64_t{four + 1} * plan.whole + start) / fours;
    std::array<std::uint8_t, 4> chosen{};
    for (std::uint64_t n = before; n < after; ++n) {
      std::uint64_t k = hash(key, Draw::of_four, four, n) % (4 - (n - before));
      for (std::size_t m = 0; m < 4; ++m)
        if (chosen[m] == 0 && k-- == 0) {
          chosen[m] = 1;
          break;
        }
    }
    for (std::uint32_t k = 0; k < 4; ++k) {
      const int x = a + static_cast<int>(k % 2), y = b + static_cast<int>(k / 2);
      const std::size_t of_column = static_cast<std::size_t>(x) * rows + static_cast<std::size_t>(y),
                        of_row = static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x);
      const Point2 u{
          (x + (across_[of_column] + unit_double(hash(key, Draw::across, x, y))) / plan.down) / plan.across,
          (y + (down_[of_row] + unit_double(hash(key, Draw::down, x, y))) / plan.across) / plan.down};
      const std::uint32_t index = chosen[k] != 0 ? followed++ : others++;
      requests.push_back({place(u, std::uint64_t{four} * 4 + k), key, index});
      whole.push_back(chosen[k]);
    }
  }
  counts.push_back(count);
}

}  // namespace ifov::sampling
