#pragma once

#include <span>
#include <vector>

#include "radiometry/node_demands.h"
#include "radiometry/node_rule.h"

namespace ifov::radiometry {

/// The smallest rule that keeps a channel within the tolerance, and the largest relative error seen with it.
struct FoundRule {
  NodeRule rule;
  double worst_error = 0.0;
};

/// `surfaces`: reflectances (and other factors) at the points of the grid.
FoundRule find_rule(const ChannelGrid& grid, std::span<const std::vector<double>> surfaces,
                    const NodeDemands& demands);

}  // namespace ifov::radiometry
