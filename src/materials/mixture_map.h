#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "materials/numbered_map.h"

namespace ifov::materials {

/// Shares of several parts in each cell of a map: the largest kMost of a cell, which sum to 1.
class MixtureMap final : public NumberedMap {
 public:
  static constexpr std::size_t kMost = 4;
  struct Part {
    std::uint16_t index = 0;
    float share = 0.0f;  ///< above 0
  };

  /// What was done to the numbers to make them shares that sum to 1.
  struct Report {
    std::size_t rescaled = 0;                    ///< cells whose numbers did not sum to 1 within kTolerance
    double lowest_sum = 1.0, highest_sum = 1.0;  ///< of their numbers
    std::size_t shortened = 0;                   ///< cells with more than kMost parts
    double largest_loss = 0.0;                   ///< largest share that was given to the other parts there
  };
  static constexpr double kTolerance = 1e-3;

  /// `bands` parts, band after band, each row by row from the north-west corner. Cells whose numbers sum to something
  /// else than 1 are rescaled. Throws InputError, naming row and column, where a number is negative or not finite or
  /// all of a cell are 0.
  MixtureMap(MapGrid grid, std::size_t bands, std::span<const float> shares);

  std::span<const Part> at(const MapPosition& position) const;
  /// The mean index of its parts.
  float number(std::size_t cell) const override;
  const Report& report() const { return report_; }

 private:
  std::vector<Part> parts_;           ///< of all cells, largest first
  std::vector<std::uint32_t> first_;  ///< of each cell, and the end
  Report report_;
};

}  // namespace ifov::materials
