#include "session/runs/resource_check.h"

#include <algorithm>

#include "core/byte_count.h"
#include "core/format.h"
#include "core/machine_memory.h"
#include "core/parallel.h"
#include "io/files/free_space.h"
#include "io/products/cube_file.h"
#include "io/run_state/run_state.h"

namespace ifov::session {

std::uint64_t buffer_bytes(const io::RunPlan& plan) {
  constexpr std::uint64_t kMostTiles = std::uint64_t{64} << 20;
  std::uint64_t bytes = std::min(kMostTiles, io::state_bytes(plan, false));
  for (const io::Quantity* quantity : plan.made_cubes()) {
    const io::CubeSize cube = io::cube_size(*quantity, plan.image);
    bytes += io::CubeFile::waiting_bytes(cube.width_px, cube.height_px, cube.bands, plan.tile_px,
                                         cube.value_bytes);
  }
  return bytes;
}

std::uint64_t least_memory_bytes(const io::RunPlan& plan, int threads) {
  constexpr std::uint64_t kLatticeValues = 9;  // of a pixel, for samplers that follow an accuracy
  const std::uint64_t workers = std::min<std::uint64_t>(
      threads > 0 ? static_cast<std::uint64_t>(threads) : static_cast<std::uint64_t>(usual_threads()),
      plan.grid().size());
  const auto side =
      static_cast<std::uint64_t>(std::min(plan.tile_px, std::max(plan.image.width_px, plan.image.height_px)));
  sampling::TileResult pixel;
  pixel.reset({0, 0, 1, 1}, static_cast<int>(plan.image.channels.size()), plan.knows_errors);
  const std::uint64_t lattice = plan.judged ? kLatticeValues * plan.image.channels.size() * sizeof(float) : 0;
  return resident_memory_bytes() + (plan.share.is_whole() ? buffer_bytes(plan) : 0) +
         workers * side * side * (pixel.bytes() + lattice);
}

std::vector<std::string> shortages(const std::filesystem::path& folder, std::uint64_t disk_bytes,
                                   std::uint64_t memory_bytes) {
  std::vector<std::string> lines;
  if (const std::uint64_t free = io::free_bytes(folder) + io::leftover_bytes(folder); disk_bytes > free)
    lines.push_back(format("{}: the run takes {} of disk, {} are free", folder.string(),
                           byte_count(disk_bytes), byte_count(free)));
  if (const std::uint64_t free = memory_within_reach_bytes(); memory_bytes > free)
    lines.push_back(
        format("the run takes {} of memory, {} are there; fewer threads or smaller tiles take less",
               byte_count(memory_bytes), byte_count(free)));
  return lines;
}

}  // namespace ifov::session
