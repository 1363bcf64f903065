#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "radiometry/channel.h"

namespace ifov::studies {

/// What the reduction to spectral nodes costs in accuracy, over Lambertian ground of several kinds (300 K in
/// the thermal infrared), against all bins and terms of the band model.
struct NodeErrors {
  std::vector<double> centre_um;  ///< of the channels
  std::vector<std::string> surfaces;
  std::vector<std::vector<double>> relative;  ///< [surface][channel], of the radiance at the sensor
  std::vector<double> claimed;                ///< by channel: the largest that the nodes' own check found
  std::size_t nodes = 0;                      ///< of all channels
};

struct NodeQuestion {
  int threads = 0;
  std::size_t most_nodes = 8;  ///< of a channel
  double tolerance = 5e-3;
  /// Every material of the built-in library, all of which emit, instead of three greys and a lawn.
  bool whole_library = false;
};
NodeErrors node_errors(std::span<const radiometry::Channel> channels, const NodeQuestion& question);

}  // namespace ifov::studies
