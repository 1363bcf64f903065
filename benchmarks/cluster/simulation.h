#pragma once

#include <vector>

namespace ifov::bench {

/// An image's tiles and what each takes, row by row.
struct TileCosts {
  int columns = 0;
  std::vector<double> seconds;
};

/// What messages take between two ranks.
struct MessageTimes {
  double round_trip_s = 0.0;  ///< from asking for tiles to having them
  double service_s = 0.0;     ///< of the first rank, for each
};

enum class Scheduling {
  shares,    ///< every n-th tile to each of n, beforehand
  rows,      ///< a counter, one tile at a time, row by row, asked for when the last one is done
  schedule,  ///< cluster::TileSchedule, asked as cluster::TileClient asks it
};

/// Seconds until the last of `ranks` of one thread each has done its last tile.
double makespan_s(const TileCosts& tiles, int ranks, const MessageTimes& messages, Scheduling scheduling);

}  // namespace ifov::bench
