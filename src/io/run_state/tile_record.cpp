#include "io/run_state/tile_record.h"

#include <algorithm>
#include <cstring>

#define XXH_INLINE_ALL
#include <xxhash.h>
#include <zstd.h>

#include "core/format.h"

namespace ifov::io {
namespace {

constexpr char kMagic[9] = "IFOVTILE";
constexpr std::uint32_t kByteOrder = 0x01020304, kFormat = 6;

std::uint64_t hash_of_header(const TileHeader& header) {
  return XXH3_64bits(&header, offsetof(TileHeader, header_hash));
}

/// Calls `visit` with means and half-widths.
template <class Tile, class Visit>
void for_each_value_array(Tile& tile, const Visit& visit) {
  visit(tile.mean);
  visit(tile.half_width);
}

/// Calls `visit` with each of the arrays that follow these in the file, in its order.
template <class Tile, class Visit>
void for_each_other_array(Tile& tile, const Visit& visit) {
  visit(tile.variance_geometry);
  visit(tile.variance_path);
  visit(tile.border_share);
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

/// Of means and half-widths.
std::uint64_t value_bytes_of(const TileHeader& header) {
  const auto pixels = static_cast<std::uint64_t>(header.rect().count());
  return sizeof(float) * pixels * static_cast<std::uint64_t>(header.columns) *
         (header.has_errors == kNoErrors ? 1 : 2);
}

/// Of the arrays beside these.
std::uint64_t other_bytes_of(const TileHeader& header) {
  const auto pixels = static_cast<std::uint64_t>(header.rect().count());
  const std::uint64_t cells = pixels * static_cast<std::uint64_t>(header.columns);
  return 4 * (has_variances(header)            ? 2 * cells
              : header.has_errors != kNoErrors ? pixels
                                               : 0) +
         pixels * (5 * 4 + sizeof(sampling::Reasons)) + (header.has_positions != 0 ? 3 * 8 * pixels : 0) +
         sizeof(sampling::Abundance) * std::uint64_t{header.abundances} + header.memory_bytes;
}

bool has_right_size(const TileHeader& header) {
  const std::uint64_t others = other_bytes_of(header);
  return header.values_in_cubes != 0 ? header.payload_bytes <= ZSTD_compressBound(others)
                                     : header.payload_bytes == value_bytes_of(header) + others;
}

std::uint64_t hash_of_values(const sampling::TileResult& tile) {
  XXH3_state_t state;
  XXH3_64bits_reset(&state);
  for_each_value_array(tile, [&](const std::vector<float>& array) {
    XXH3_64bits_update(&state, array.data(), sizeof(float) * array.size());
  });
  return XXH3_64bits_digest(&state);
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
  header.has_errors = !tile.has_errors()               ? kNoErrors
                      : tile.variance_geometry.empty() ? kHalfWidthsAlone
                                                       : kWithVariances;
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

  std::size_t value_bytes = 0, bytes = sizeof header;
  const auto size_of = [](const auto& array) { return sizeof(array[0]) * array.size(); };
  for_each_value_array(tile, [&](const auto& array) { value_bytes += size_of(array); });
  for_each_other_array(tile, [&](const auto& array) { bytes += size_of(array); });
  bytes += value_bytes;
  std::vector<std::byte> record(bytes);
  std::byte* to = record.data() + sizeof header;
  const auto put = [&](const auto& array) {
    if (!array.empty()) std::memcpy(to, array.data(), size_of(array));
    to += size_of(array);
  };
  for_each_value_array(tile, put);
  for_each_other_array(tile, put);
  header.payload_bytes = bytes - sizeof header;
  const std::byte* const values = record.data() + sizeof header;
  header.values_hash = XXH3_64bits(values, value_bytes);
  header.payload_hash = XXH3_64bits(values + value_bytes, header.payload_bytes - value_bytes);
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
      header.y1 != place.y1 || header.columns != demands.columns || !has_right_size(header))
    return "it does not fit the image";
  return {};
}

std::string decode_tile(const TileHeader& header, std::span<const std::byte> payload,
                        const ReadValues& read_values, sampling::TileResult& tile) {
  const std::string wrong = format("the checksum of tile {} is wrong", header.index);
  if (payload.size() != header.payload_bytes || !has_right_size(header)) return wrong;
  std::span<const std::byte> values, others;
  std::vector<std::byte> unpacked;
  if (header.values_in_cubes != 0) {
    unpacked.resize(other_bytes_of(header));
    if (ZSTD_decompress(unpacked.data(), unpacked.size(), payload.data(), payload.size()) != unpacked.size())
      return wrong;
    others = unpacked;
  } else {
    values = payload.first(value_bytes_of(header));
    others = payload.subspan(values.size());
  }
  if (XXH3_64bits(others.data(), others.size()) != header.payload_hash) return wrong;
  tile.reset(header.rect(), header.columns, header.has_errors != kNoErrors);
  if (header.has_errors == kHalfWidthsAlone) tile.drop_variances();
  if (header.has_positions != 0) tile.position_m.resize(3 * tile.samples.size());
  tile.abundances.resize(header.abundances);
  tile.memory.resize(header.memory_bytes);
  const auto take_from = [](std::span<const std::byte>& from) {
    return [&from](auto& array) {
      const std::size_t size = sizeof(array[0]) * array.size();
      if (size > 0) std::memcpy(array.data(), from.data(), size);
      from = from.subspan(size);
    };
  };
  if (header.values_in_cubes == 0) {
    if (XXH3_64bits(values.data(), values.size()) != header.values_hash) return wrong;
    for_each_value_array(tile, take_from(values));
  } else if (!read_values || !read_values(tile, [&] { return hash_of_values(tile) == header.values_hash; })) {
    return format("the values of tile {} are in the cubes no more", header.index);
  }
  for_each_other_array(tile, take_from(others));
  tile.halo_samples = header.halo_samples;
  tile.seed_samples = header.seed_samples;
  tile.probe_samples = header.probe_samples;
  tile.rays = {header.primary_rays, header.shadow_rays, header.bounce_rays};
  return {};
}

std::vector<std::byte> without_values(const TileHeader& header, std::span<const std::byte> payload) {
  if (header.values_in_cubes != 0 || has_variances(header)) return {};
  const std::span<const std::byte> others = payload.subspan(value_bytes_of(header));
  constexpr int kLevel = 1;  // the quickest
  std::vector<std::byte> record(sizeof header + ZSTD_compressBound(others.size()));
  const std::size_t packed = ZSTD_compress(record.data() + sizeof header, record.size() - sizeof header,
                                           others.data(), others.size(), kLevel);
  if (ZSTD_isError(packed) != 0) return {};
  record.resize(sizeof header + packed);
  TileHeader rest = header;
  rest.values_in_cubes = 1;
  rest.payload_bytes = packed;
  rest.header_hash = hash_of_header(rest);
  std::memcpy(record.data(), &rest, sizeof rest);
  return record;
}

}  // namespace ifov::io
