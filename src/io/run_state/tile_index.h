#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/run_state/tile_record.h"

namespace ifov::io {

struct RunPlan;

/// Where the finished tiles of a run lie in packs, so that they can be read in any order.
class TileIndex {
 public:
  explicit TileIndex(const RunPlan& plan);

  /// The tiles of a pack, by their headers, up to a damaged one; of a tile that is known already the first place stays.
  /// `seen` (may be empty) gets each header. Throws SystemError where the pack cannot be read.
  void add(const std::filesystem::path& pack, const std::function<void(const TileHeader&)>& seen = {});

  bool has(std::size_t index) const { return positions_[index].bytes > 0; }

  /// From any thread. What is wrong with the tile, in words; empty where it is whole.
  std::string read(std::size_t index, const ReadValues& read_values, sampling::TileResult& tile) const;

 private:
  struct Position {
    std::size_t pack = 0;
    std::uint64_t offset = 0, bytes = 0;  // none: 0 bytes
  };
  std::uint64_t run_;
  int columns_;
  std::vector<sampling::PixelRect> grid_;
  std::vector<std::filesystem::path> packs_;
  std::vector<Position> positions_;
};

}  // namespace ifov::io
