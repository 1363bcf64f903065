#pragma once

#include <cstdint>
#include <vector>

#include "sampling/field.h"
#include "sampling/image/bright_places.h"

namespace ifov::sampling {

class FootprintGroups;
class PixelFootprint;
struct TileProblem;

/// How many values a pixel gets: of the first level one in each of across x down equal cells of its footprint, both even; of the
/// second at `whole` of these.
struct PixelPlan {
  int across = 4, down = 4;
  std::uint32_t whole = 8;
  std::uint32_t count() const { return static_cast<std::uint32_t>(across * down); }
};

/// Requests for levels(), group by group.
struct PixelPoints {
  std::vector<PathRequest> requests;
  std::vector<std::uint8_t> whole;
  std::vector<std::uint32_t> counts;
  std::vector<float> importance;  ///< LevelRequests::importance

  void clear();
  /// Of a pixel of this problem, under its footprint or, where channels have several, their mixture; of what of it is in none of its
  /// bright places.
  void add(const TileProblem& problem, const BrightShares& bright, int i, int j, std::uint64_t key,
           const PixelPlan& plan);
  /// The same of what of it is in one of them.
  void add(const TileProblem& problem, const BrightPlaces::Rectangle& where, int i, int j, std::uint64_t key,
           const PixelPlan& plan);
  /// Of pixel (i, j): one in each cell, in fours of cells side by side, and one in each of as many thin columns and rows as there are
  /// cells (multi-jittered sampling: Chiu, Shirley and Wang 1994). Of which cells the path is followed is drawn so that each has the
  /// same chance and every four about as many. `key`: of the pixel's random numbers and paths.
  void add(const PixelFootprint& footprint, int i, int j, std::uint64_t key, const PixelPlan& plan);

 private:
  /// `place(u, k)`: of the unit square, for the k-th point.
  template <class PlaceOf>
  void add_points(std::uint64_t key, const PixelPlan& plan, const PlaceOf& place);
  void add_importance(const TileProblem& problem, int i, int j, const PixelPlan& plan);
  std::vector<int> across_,
      down_;  // which thin column, column by column of cells; which thin row, row by row
};

}  // namespace ifov::sampling
