#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "io/run_state/tile_record.h"

namespace ifov::io {

/// The packs of a folder, oldest first. None where there is no such folder.
std::vector<std::filesystem::path> packs_in(const std::filesystem::path& folder);

/// Each whole tile of a pack goes to `take`; `read_values` as for decode_tile(). What is damaged or cut short is told to `log` (may be null);
/// where `repair`, the pack is then left with its whole tiles alone, or taken away. Throws SystemError
/// where the pack cannot be read.
void read_pack(const std::filesystem::path& pack, const TileDemands& demands, const ReadValues& read_values,
               const std::function<void(const TileHeader&, const sampling::TileResult&)>& take, LogSink* log,
               bool repair);

/// Leaves out of a pack of whole tiles the values that lie in the run's cubes (without_values()). Throws SystemError
/// where the pack cannot be read or written; the pack then stays as it was.
void move_values_out(const std::filesystem::path& pack, const TileDemands& demands);

/// The headers alone, for those who want to know how far a run is; stops where the pack is damaged.
void read_headers(const std::filesystem::path& pack, const TileDemands& demands,
                  const std::function<void(const TileHeader&)>& take);

}  // namespace ifov::io
