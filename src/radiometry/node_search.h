#pragma once

#include <span>
#include <vector>

#include "radiometry/node_rule.h"

namespace ifov::radiometry {

/// The smallest rule that keeps a channel within the tolerance, and the largest relative error seen with it.
struct FoundRule {
  NodeRule rule;
  double worst_error = 0.0;
};

/// `surfaces`: reflectances at the points of the grid. Stops at `kMostParts` parts, whatever the error then.
FoundRule find_rule(const ChannelGrid& grid, std::span<const std::vector<double>> surfaces, double tolerance);

inline constexpr int kMostParts = 32;

}  // namespace ifov::radiometry
