#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ifov::io {
struct RunPlan;
}

namespace ifov::session {

/// Memory that a run takes at most beside scene and tiles in work: the strips of products that wait to be written, and
/// tiles on their way.
std::uint64_t buffer_bytes(const io::RunPlan& plan);

/// Memory that a run takes at least, with what is held now: buffers, and a tile for each thread. Cheap to know; what
/// tiles take beyond that shows in a probe (forecast_run()).
std::uint64_t least_memory_bytes(const io::RunPlan& plan, int threads);

/// What a run will find too little of, "out: the run takes 3.1 TB of disk, 0.2 TB are free"; none: it will do. What an
/// earlier start has left in the folder counts as free, because this run writes it anew or goes on with it.
std::vector<std::string> shortages(const std::filesystem::path& folder, std::uint64_t disk_bytes,
                                   std::uint64_t memory_bytes);

}  // namespace ifov::session
