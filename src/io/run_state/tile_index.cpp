#include "io/run_state/tile_index.h"

#include <cstring>
#include <fstream>
#include <span>

#include "core/format.h"
#include "io/run_state/run_plan.h"
#include "io/run_state/tile_packs.h"

namespace ifov::io {

TileIndex::TileIndex(const RunPlan& plan)
    : run_(plan.key()),
      columns_(static_cast<int>(plan.image.channels.size())),
      grid_(plan.grid()),
      positions_(grid_.size()) {}

void TileIndex::add(const std::filesystem::path& pack, const std::function<void(const TileHeader&)>& seen) {
  std::uint64_t offset = 0;
  read_headers(pack, {run_, columns_, grid_}, [&](const TileHeader& header) {
    Position& position = positions_[header.index];
    if (position.bytes == 0) position = {packs_.size(), offset, header.record_bytes()};
    offset += header.record_bytes();
    if (seen) seen(header);
  });
  packs_.push_back(pack);
}

std::string TileIndex::read(std::size_t index, const ReadValues& read_values,
                            sampling::TileResult& tile) const {
  const Position& position = positions_[index];
  if (position.bytes < sizeof(TileHeader)) return format("there is no tile {}", index);
  const std::filesystem::path& pack = packs_[position.pack];
  std::vector<std::byte> record(position.bytes);
  std::ifstream file(pack, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(position.offset));
  file.read(reinterpret_cast<char*>(record.data()), static_cast<std::streamsize>(record.size()));
  if (!file) return format("{}: tile {} cannot be read", pack.string(), index);
  TileHeader header;
  std::memcpy(&header, record.data(), sizeof header);
  const std::string fault = fault_of(header, {run_, columns_, grid_});
  if (!fault.empty()) return format("{}: tile {} is not taken, {}", pack.string(), index, fault);
  if (header.index != index) return format("{}: tile {} lies there no more", pack.string(), index);
  const std::string damage =
      decode_tile(header, std::span<const std::byte>(record).subspan(sizeof header), read_values, tile);
  return damage.empty() ? damage : format("{}: {}", pack.string(), damage);
}

}  // namespace ifov::io
