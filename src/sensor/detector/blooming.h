#pragma once

#include <cstddef>
#include <span>

namespace ifov::sensor {

/// Of elements in a row, `count` from `first` on, each `stride` after the last: what of their electrons does not fit into their wells runs
/// over, half of `share` of it to each side, into the next ones that have room; the rest, and what runs over the ends, is lost.
void run_over(std::span<double> electrons, std::size_t first, std::size_t stride, std::size_t count,
              double well, double share);

}  // namespace ifov::sensor
