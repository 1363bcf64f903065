#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "radiometry/channel_grid.h"
#include "radiometry/node_demands.h"
#include "radiometry/node_rule.h"

namespace ifov::radiometry {

/// A part of the channel with what tells how well its nodes stand for it.
struct TrialPart {
  ChannelPart part;
  double variance = 0.0;  // of the spectra within it, times its measure
  double residual = 0.0;  // what is left of that when they are taken as linear in the part's variable
  double left() const { return part.order == 1 ? variance : residual; }
};

/// Spectra as deviations that matter equally: reflectances by their channel mean (of 0.1 at least, the square
/// root of kDarkShare), blackbodies by the reference radiance.
class NodeShapes {
 public:
  NodeShapes(const ChannelGrid& grid, std::span<const std::span<const double>> surfaces,
             const NodeDemands& demands);

  /// Variables at a part's points, each with both signs: the part's own, and what the air passes and sends.
  std::vector<std::vector<double>> ways_to_divide(const TrialPart& part) const;
  /// Finds the first principal component of the shapes over the part, which becomes its variable.
  TrialPart analysed(std::vector<std::uint32_t> points) const;

 private:
  std::vector<double> measure_;
  std::vector<std::vector<double>> shapes_;  // surfaces, what the air passes, the sky, what glows
  std::size_t first_of_air_ = 0, emissions_ = 0;
};

}  // namespace ifov::radiometry
