#include "io/run_state/tile_record.h"

#include <algorithm>
#include <cstring>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace ifov::io {
namespace {

constexpr char kMagic[9] = "IFOVTILE";
constexpr std::uint32_t kByteOrder = 0x01020304, kFormat = 5;

std::uint64_t hash_of_header(const TileHeader& header) {
  return XXH3_64bits(&header, offsetof(TileHeader, header_hash));
}

/// Calls `visit` with each array of the tile, in the order of the file.
template <class Tile, class Visit>
void for_each_array(Tile& tile, const Visit& visit) {
  visit(tile.mean);
  visit(tile.variance_geometry);
  visit(tile.variance_path);
  visit(tile.border_share);
  visit(tile.half_width);
  visit(tile.samples);
  visit(tile.label_rays);
  visit(tile.radiance_evaluations);
  visit(tile.worst_ratio);
  visit(tile.missable_fraction);
  visit(tile.abundances);
  visit(tile.position_m);
  visit(tile.reasons);
  visit(tile.memory);
}

/// TileHeader::has_errors
enum Errors : std::uint32_t { kNoErrors, kWithVariances, kHalfWidthsAlone };

bool has_variances(const TileHeader& header) { return header.has_errors == kWithVariances; }

std::uint64_t arrays_of(const TileHeader& header) {
  return header.has_errors == kNoErrors ? 1 : has_variances(header) ? 4 : 2;
}

std::uint64_t payload_bytes_of(const TileHeader& header) {
  const auto pixels = static_cast<std::uint64_t>(header.rect().count());
  const std::uint64_t cells = pixels * static_cast<std::uint64_t>(header.columns);
  return 4 * cells * arrays_of(header) + 4 * (has_variances(header) ? 0 : header.has_errors != 0 ? pixels : 0) +
         pixels * (5 * 4 + sizeof(sampling::Reasons)) + (header.has_positions != 0 ? 3 * 8 * pixels : 0) +
         sizeof(sampling::Abundance) * std::uint64_t{header.abundances} + header.memory_bytes;
}

}  // namespace

std::vector<std::byte> encode_tile(const sampling::TileResult& tile, const TileStamp& stamp) {
  static_assert(sizeof(sampling::Abundance) == 16);
  TileHeader header{};
  std::memcpy(header.magic, kMagic, sizeof header.magic);
  header.byte_order = kByteOrder;
  header.format = kFormat;
  header.index = stamp.index;
  header.x0 = tile.tile.x0, header.y0 = tile.tile.y0, header.x1 = tile.tile.x1, header.y1 = tile.tile.y1;
  header.columns = tile.columns;
  header.has_errors = !tile.has_errors() ? kNoErrors : tile.variance_geometry.empty() ? kHalfWidthsAlone : kWithVariances;
  header.has_positions = tile.position_m.empty() ? 0 : 1;
  header.abundances = static_cast<std::uint32_t>(tile.abundances.size());
  header.halo_samples = tile.halo_samples;
  header.seed_samples = tile.seed_samples;
  header.probe_samples = tile.probe_samples;
  header.primary_rays = tile.rays.primary;
  header.shadow_rays = tile.rays.shadow;
  header.bounce_rays = tile.rays.bounce;
  header.start = stamp.start;
  header.elapsed_s = stamp.elapsed_s;
  header.converged = static_cast<std::uint32_t>(tile.converged_count());
  sampling::ReasonCounts reasons{};
  sampling::add_reasons(tile.reasons, reasons);
  std::copy(reasons.begin(), reasons.end(), header.reasons);
  for (const float ratio : tile.worst_ratio) header.worst_ratio = std::max(header.worst_ratio, ratio);
  header.run = stamp.run;
  header.memory_bytes = tile.memory.size();

  std::size_t bytes = sizeof header;
  for_each_array(tile, [&](const auto& array) { bytes += sizeof(array[0]) * array.size(); });
  std::vector<std::byte> record(bytes);
  std::byte* to = record.data() + sizeof header;
  for_each_array(tile, [&](const auto& array) {
    const std::size_t size = sizeof(array[0]) * array.size();
    if (size > 0) std::memcpy(to, array.data(), size);
    to += size;
  });
  header.payload_bytes = bytes - sizeof header;
  header.payload_hash = XXH3_64bits(record.data() + sizeof header, header.payload_bytes);
  header.header_hash = hash_of_header(header);
  std::memcpy(record.data(), &header, sizeof header);
  return record;
}

std::string fault_of(const TileHeader& header, const TileDemands& demands) {
  if (std::memcmp(header.magic, kMagic, sizeof header.magic) != 0 ||
      header.header_hash != hash_of_header(header))
    return "its header is damaged";
  if (header.byte_order != kByteOrder) return "it was written on a machine of another byte order";
  if (header.format != kFormat) return "it is of another format";
  if (header.run != demands.run) return "it belongs to another run";
  const bool in_grid = header.index < demands.grid.size();
  const sampling::PixelRect place = in_grid ? demands.grid[header.index] : sampling::PixelRect{};
  if (!in_grid || header.x0 != place.x0 || header.y0 != place.y0 || header.x1 != place.x1 ||
      header.y1 != place.y1 || header.columns != demands.columns ||
      header.payload_bytes != payload_bytes_of(header))
    return "it does not fit the image";
  return {};
}

bool decode_tile(const TileHeader& header, std::span<const std::byte> payload, sampling::TileResult& tile) {
  if (payload.size() != header.payload_bytes ||
      XXH3_64bits(payload.data(), payload.size()) != header.payload_hash)
    return false;
  tile.reset(header.rect(), header.columns, header.has_errors != kNoErrors);
  if (header.has_errors == kHalfWidthsAlone) tile.drop_variances();
  if (header.has_positions != 0) tile.position_m.resize(3 * tile.samples.size());
  tile.abundances.resize(header.abundances);
  tile.memory.resize(header.memory_bytes);
  const std::byte* from = payload.data();
  for_each_array(tile, [&](auto& array) {
    const std::size_t size = sizeof(array[0]) * array.size();
    if (size > 0) std::memcpy(array.data(), from, size);
    from += size;
  });
  tile.halo_samples = header.halo_samples;
  tile.seed_samples = header.seed_samples;
  tile.probe_samples = header.probe_samples;
  tile.rays = {header.primary_rays, header.shadow_rays, header.bounce_rays};
  return true;
}

}  // namespace ifov::io
