#pragma once

#include <cstddef>
#include <vector>

namespace ifov::atmosphere {

/// Terms that stand for each other: their indices and the sum of their weights.
struct TermGroup {
  double weight = 0.0;
  std::vector<std::size_t> members;
};

/// Joins terms, always the two whose joining changes transmittance least in the sense of least squares over
/// paths of many lengths through all, the lower and the upper layers, until `most` are left (Ward 1963).
/// `depth` is [term][layer].
std::vector<TermGroup> joined_terms(const std::vector<double>& weight,
                                    const std::vector<std::vector<double>>& depth, std::size_t most);

}  // namespace ifov::atmosphere
