#pragma once

#include <cstddef>
#include <vector>

#include "radiometry/spectrum.h"

namespace ifov::radiometry {

/// What the nodes of a channel have to be right for. Asking for less gives fewer nodes.
struct NodeDemands {
  /// Allowed relative error of a channel's radiance; radiances darker than a hundredth of a white surface's
  /// (a tenth of a blackbody's, for thermal light) may err by as much as that would.
  double tolerance = 7e-4;
  /// Surfaces that sunlight meets on its way, 1 to 3; thermal light meets one less. With 1, and nothing that
  /// glows, each sunlit channel has one node.
  int reflections = 3;
  /// Temperatures of what emits; a hottest of 0: nothing does.
  double coldest_k = 200.0;
  double hottest_k = 1000.0;
  /// Every surface emits, at coldest_k at least: then radiances are judged as wholes, what is emitted and what is
  /// reflected, and not the darkest of their parts by itself.
  bool all_glow = false;
  /// Light that surfaces give off as lamps, of any unit.
  std::vector<Spectrum> lamps{};
  /// Nodes of a channel, whatever the error then.
  std::size_t most_nodes = 64;
};

}  // namespace ifov::radiometry
