#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "radiometry/node_demands.h"
#include "radiometry/node_rule.h"

namespace ifov::radiometry {

/// The smallest rule that keeps a channel within the tolerance, and the largest relative error seen with it.
struct FoundRule {
  NodeRule rule;
  double worst_error = 0.0;
  std::size_t judged = 0;  ///< radiances that rules were judged by on the way, all together: the work of it
};

/// Up to here all surfaces are judged together. Of more (models with many spectra each, such as reflectance by angle) a rule
/// is sought for those that vary most and some others, judged by all, and sought again with those that it keeps least.
inline constexpr std::size_t kMostJudgedTogether = 640;

/// `surfaces`: reflectances (and other factors) at the points of the grid.
FoundRule find_rule(const ChannelGrid& grid, std::span<const std::vector<double>> surfaces,
                    const NodeDemands& demands);

}  // namespace ifov::radiometry
