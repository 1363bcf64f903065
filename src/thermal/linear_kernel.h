#pragma once

#include <cstddef>
#include <vector>

namespace ifov::thermal {

struct Cells;
struct History;

/// What the past is worth: kelvins of the surface at node `now` per W m-2 that it gained more at each node up to there, to
/// first order about a history. A gain a(t) that is linear between nodes adds the sum of kernel[i] a(t_i). The transposed
/// steps of the history itself, so that there is no error but that of leaving out higher orders. `of_start`: where not null, kelvins per kelvin of each cell at the first node.
std::vector<double> linear_kernel(const Cells& cells, const History& history, std::size_t now,
                                  std::vector<double>* of_start = nullptr);

}  // namespace ifov::thermal
