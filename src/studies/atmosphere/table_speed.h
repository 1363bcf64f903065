#pragma once

#include <span>
#include <vector>

#include "radiometry/channel.h"

namespace ifov::studies {

/// Channels whose tables are timed: 210 of 10 nm from 0.4 to 2.5 um, 10 from 8 to 12.5 um, and the nine
/// reflective ones of Landsat 8 as rectangles.
std::vector<radiometry::Channel> timed_vswir();
std::vector<radiometry::Channel> timed_thermal();
std::vector<radiometry::Channel> timed_multispectral();

struct TableSpeed {
  double seconds = 0.0;
  double cpu_seconds = 0.0;  ///< of all threads, in user mode: steadier where others use the machine
  std::size_t nodes = 0;
  bool right = true;  ///< the first channel within 0.5 % of all its bins and terms: wrong tables are not fast
};

/// Builds the tables of a sensor that looks straight down over grass and asphalt, from nothing, with the
/// estimate of their own errors.
TableSpeed time_tables(std::span<const radiometry::Channel> channels, int threads);

}  // namespace ifov::studies
