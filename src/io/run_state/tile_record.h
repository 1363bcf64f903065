#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sampling/reason_words.h"
#include "sampling/tile.h"

namespace ifov::io {

/// What a finished tile is kept as: this header, a list of the arrays, and these (docs/formats/run_state.md). Nothing
/// here knows what they hold: an array or a layer that a tile gains is kept, too. The hashes are of the list, of the
/// arrays that lie in cubes as well, of the others, and of the header before it.
struct TileHeader {
  char magic[8];
  std::uint32_t byte_order, format;
  std::uint32_t index;          ///< in the image's grid of tiles, row by row
  std::int32_t x0, y0, x1, y1;  ///< pixels [x0, x1) x [y0, y1)
  std::int32_t columns;
  std::uint32_t arrays;  ///< in the list
  /// 1: means and half-widths lie in the run's cubes, the others are compressed.
  std::uint32_t values_in_cubes;
  std::uint64_t payload_bytes;
  std::uint64_t halo_samples, pilot_samples, probe_samples;
  std::uint64_t primary_rays, shadow_rays, continuation_rays;
  std::uint64_t start;      ///< tells the starts of a run apart
  double elapsed_s;         ///< since that start
  std::uint32_t converged;  ///< pixels
  float worst_ratio;
  std::uint32_t reasons[sampling::kReasonNames.size()];  ///< pixels, by reason why they are not converged
  std::uint64_t run;                                     ///< which run the tile belongs to, RunPlan::key()
  std::uint64_t list_hash, values_hash, payload_hash, header_hash;

  std::uint64_t record_bytes() const { return sizeof(TileHeader) + payload_bytes; }
  sampling::PixelRect rect() const { return {x0, y0, x1, y1}; }
};
static_assert(sizeof(TileHeader) == 208);

/// What a tile's header says besides the tile.
struct TileStamp {
  std::uint32_t index = 0;
  std::uint64_t start = 0, run = 0;
  double elapsed_s = 0.0;
};

/// Header and arrays, one behind the other.
std::vector<std::byte> encode_tile(const sampling::TileResult& tile, const TileStamp& stamp);

/// Of what a record holds beside its arrays.
std::uint64_t frame_bytes(const sampling::TileResult& tile);

/// What the header must say, beside being whole: a record of another run or image is not taken.
struct TileDemands {
  std::uint64_t run = 0;
  int columns = 0;
  std::span<const sampling::PixelRect> grid;
};

/// What is wrong with a header, in words ("its header is damaged"); empty where it is right. Only then may
/// its sizes be believed.
std::string fault_of(const TileHeader& header, const TileDemands& demands);

/// Fills a tile's means and half-widths, where it has any, from a run's cubes, until `is_right` takes them; false where
/// it never does.
using ReadValues = std::function<bool(sampling::TileResult& tile, const std::function<bool()>& is_right)>;

/// The tile of a header without fault and of its arrays. What is wrong, in words ("the checksum of tile 3 is wrong"); empty
/// where it is whole. `read_values` is for records without them.
std::string decode_tile(const TileHeader& header, std::span<const std::byte> payload,
                        const ReadValues& read_values, sampling::TileResult& tile);

/// The record of such a tile whose means and half-widths lie in the cubes. Empty for one that holds none already.
std::vector<std::byte> without_values(const TileHeader& header, std::span<const std::byte> payload);

}  // namespace ifov::io
