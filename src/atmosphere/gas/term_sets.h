#pragma once

#include <cstddef>
#include <vector>

namespace ifov::atmosphere {

/// Points into at most `count` sets whose members differ least from their mean, in the sum of squares weighted with the points'
/// shares: the set of each point, from 0, none of them empty. `features` is [point * width + feature]. Lloyd's iteration from
/// pieces of equal length along the points in order of the sum of their features; the same for the same points.
std::vector<std::size_t> term_sets(const std::vector<double>& share, const std::vector<double>& features,
                                   std::size_t width, std::size_t count);

}  // namespace ifov::atmosphere
