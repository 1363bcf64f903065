#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/run_control.h"

namespace ifov::scene {
class TemperaturesOfTimes;
}

namespace ifov::render {

struct RenderControl;
struct RenderJob;
class TileSink;

/// An image of one time of a series.
struct ImageOfTime {
  const RenderJob& job;
  TileSink* sink;
  ProgressSink* progress;
  std::vector<bool> wanted;  ///< by tile; empty: none
};

/// Why images of several times cannot share their paths, in words; empty: they can. Of jobs that differ in how warm surfaces are, and in
/// what follows from that alone.
std::string cannot_share_paths(std::span<const RenderJob* const> by_time);

/// Renders them tile by tile, each tile at all times before the next, along paths that all times share (SharedPaths). Of `control`
/// what is no image's own; `most_bytes` by thread for what is shared. A tile's result depends on the jobs of all times and the tile
/// alone. Returns the seconds that each time counts. Throws Cancelled.
std::vector<double> render_times(std::span<const ImageOfTime> images,
                                 const scene::TemperaturesOfTimes& temperatures, const RenderControl& control,
                                 std::size_t most_bytes);

}  // namespace ifov::render
