#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "render/series/image_of_time.h"

namespace ifov::scene {
class TemperaturesOfTimes;
}

namespace ifov::render {

struct RenderControl;
struct RenderJob;

/// Why images of several times cannot share their paths, in words; empty: they can. Of jobs that differ in how warm surfaces are, and in
/// what follows from that alone.
std::string cannot_share_paths(std::span<const RenderJob* const> by_time);

/// Renders images of times that can share their paths (cannot_share_paths()) tile by tile, each tile at all times before the next, along paths that all times share (SharedPaths). Of `control`
/// what is no image's own; `most_bytes` by thread for what is shared. A tile's result depends on the jobs of all times and the tile
/// alone. Returns the seconds that each time counts. Throws Cancelled.
std::vector<double> render_times(std::span<const ImageOfTime> images,
                                 const scene::TemperaturesOfTimes& temperatures, const RenderControl& control,
                                 std::size_t most_bytes);

}  // namespace ifov::render
