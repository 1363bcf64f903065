#include "io/run_state/tile_record.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string_view>

#define XXH_INLINE_ALL
#include <xxhash.h>
#include <zstd.h>

#include "core/format.h"
#include "sampling/tile_arrays.h"

namespace ifov::io {
namespace {

constexpr char kMagic[9] = "IFOVTILE";
constexpr std::uint32_t kByteOrder = 0x01020304, kRecordFormat = 7;

std::uint64_t hash_of_header(const TileHeader& header) {
  return XXH3_64bits(&header, offsetof(TileHeader, header_hash));
}

/// A line of the list of arrays.
struct ArrayEntry {
  char name[32];              ///< ends with a zero
  std::uint32_t value_bytes;  ///< of an element
  std::uint32_t bands;        ///< of a layer; 0: a member of the tile
  std::uint64_t count;        ///< elements

  std::string_view shown_name() const { return {name, strnlen(name, sizeof name)}; }
  std::uint64_t bytes() const { return value_bytes * count; }
};
static_assert(sizeof(ArrayEntry) == 48);

ArrayEntry entry_of(std::string_view name, std::size_t value_bytes, std::uint32_t bands, std::size_t count) {
  ArrayEntry entry{};
  if (name.empty() || name.size() >= sizeof entry.name)
    throw std::logic_error("a tile's array needs a short name");
  std::copy(name.begin(), name.end(), entry.name);
  entry.value_bytes = static_cast<std::uint32_t>(value_bytes);
  entry.bands = bands;
  entry.count = count;
  return entry;
}

/// The list of a record, and where its arrays lie.
class ArrayList {
 public:
  /// `payload`: as of a header without fault.
  ArrayList(const TileHeader& header, std::span<const std::byte> payload) {
    const std::size_t size = sizeof(ArrayEntry) * std::size_t{header.arrays};
    if (header.arrays > kMostArrays || payload.size() < size ||
        XXH3_64bits(payload.data(), size) != header.list_hash)
      return;
    entries_.resize(header.arrays);
    std::memcpy(entries_.data(), payload.data(), size);
    for (const ArrayEntry& entry : entries_) {
      if (entry.value_bytes > kMostValueBytes || entry.count > kMostElements) return;
      (is_value(entry) ? value_bytes_ : other_bytes_) += entry.bytes();
    }
    const std::uint64_t left = payload.size() - size;
    whole_ = header.values_in_cubes != 0 ? left <= ZSTD_compressBound(other_bytes_)
                                         : left == value_bytes_ + other_bytes_;
    arrays_ = payload.subspan(size);
  }

  bool whole() const { return whole_; }
  const std::vector<ArrayEntry>& entries() const { return entries_; }
  std::uint64_t value_bytes() const { return value_bytes_; }
  std::uint64_t other_bytes() const { return other_bytes_; }
  /// What follows the list.
  std::span<const std::byte> arrays() const { return arrays_; }

  static bool is_value(const ArrayEntry& entry) {
    bool found = false;
    sampling::TileResult tile;
    sampling::TileResult::visit_arrays(tile, [&](const sampling::TileArray& array, const auto&) {
      found = found || (entry.bands == 0 && array.in_cubes && array.name == entry.shown_name());
    });
    return found;
  }

 private:
  static constexpr std::uint32_t kMostArrays = 1000, kMostValueBytes = 1 << 16;
  static constexpr std::uint64_t kMostElements = std::uint64_t{1} << 38;

  std::vector<ArrayEntry> entries_;
  std::span<const std::byte> arrays_;
  std::uint64_t value_bytes_ = 0, other_bytes_ = 0;
  bool whole_ = false;
};

/// An array on its way into a record.
struct ArrayBytes {
  ArrayEntry entry;
  const void* data;
  bool in_cubes;
};

/// In the order of the file: those that lie in cubes as well, the others, the layers.
std::vector<ArrayBytes> arrays_of(const sampling::TileResult& tile) {
  std::vector<ArrayBytes> arrays;
  sampling::TileResult::visit_arrays(tile, [&](const sampling::TileArray& array, const auto& values) {
    if (!values.empty())
      arrays.push_back(
          {entry_of(array.name, sizeof(values[0]), 0, values.size()), values.data(), array.in_cubes});
  });
  for (const sampling::TileLayer& layer : tile.layers)
    if (layer.value_bytes > 0 && layer.bands > 0)
      arrays.push_back(
          {entry_of(layer.name, layer.value_bytes, layer.bands, layer.bytes.size() / layer.value_bytes),
           layer.bytes.data(), false});
  std::stable_partition(arrays.begin(), arrays.end(), [](const ArrayBytes& array) { return array.in_cubes; });
  return arrays;
}

/// Makes room for an array in a tile; where its bytes belong, or null where a tile has none of this kind.
void* make_room(const ArrayEntry& entry, sampling::TileResult& tile) {
  if (entry.bands > 0) {
    tile.layers.push_back({std::string(entry.shown_name()), entry.value_bytes, entry.bands,
                           std::vector<std::byte>(entry.bytes())});
    return tile.layers.back().bytes.data();
  }
  void* position = nullptr;
  sampling::TileResult::visit_arrays(tile, [&](const sampling::TileArray& array, auto& values) {
    if (array.name != entry.shown_name() || sizeof(values[0]) != entry.value_bytes) return;
    values.resize(entry.count);
    position = values.data();
  });
  return position;
}

std::uint64_t hash_of_values(const sampling::TileResult& tile) {
  XXH3_state_t state;
  XXH3_64bits_reset(&state);
  sampling::TileResult::visit_arrays(tile, [&](const sampling::TileArray& array, const auto& values) {
    if (array.in_cubes) XXH3_64bits_update(&state, values.data(), sizeof(values[0]) * values.size());
  });
  return XXH3_64bits_digest(&state);
}

}  // namespace

std::vector<std::byte> encode_tile(const sampling::TileResult& tile, const TileStamp& stamp) {
  static_assert(sizeof(sampling::Abundance) == 16);
  TileHeader header{};
  std::memcpy(header.magic, kMagic, sizeof header.magic);
  header.byte_order = kByteOrder;
  header.format = kRecordFormat;
  header.index = stamp.index;
  header.x0 = tile.tile.x0, header.y0 = tile.tile.y0, header.x1 = tile.tile.x1, header.y1 = tile.tile.y1;
  header.columns = tile.columns;
  header.halo_samples = tile.halo_samples;
  header.pilot_samples = tile.pilot_samples;
  header.probe_samples = tile.probe_samples;
  header.primary_rays = tile.rays.primary;
  header.shadow_rays = tile.rays.shadow;
  header.continuation_rays = tile.rays.continuation;
  header.start = stamp.start;
  header.elapsed_s = stamp.elapsed_s;
  header.converged = static_cast<std::uint32_t>(tile.converged_count());
  sampling::ReasonCounts reasons{};
  sampling::add_reasons(tile.reasons, reasons);
  std::copy(reasons.begin(), reasons.end(), header.reasons);
  for (const float ratio : tile.worst_ratio) header.worst_ratio = std::max(header.worst_ratio, ratio);
  header.run = stamp.run;

  const std::vector<ArrayBytes> arrays = arrays_of(tile);
  header.arrays = static_cast<std::uint32_t>(arrays.size());
  const std::size_t list_bytes = sizeof(ArrayEntry) * arrays.size();
  std::size_t value_bytes = 0, other_bytes = 0;
  for (const ArrayBytes& array : arrays) (array.in_cubes ? value_bytes : other_bytes) += array.entry.bytes();
  header.payload_bytes = list_bytes + value_bytes + other_bytes;
  std::vector<std::byte> record(sizeof header + header.payload_bytes);
  std::byte *const list = record.data() + sizeof header, *const values = list + list_bytes;
  std::byte *to_list = list, *to = values;
  for (const ArrayBytes& array : arrays) {
    std::memcpy(to_list, &array.entry, sizeof array.entry);
    to_list += sizeof array.entry;
    std::memcpy(to, array.data, array.entry.bytes());
    to += array.entry.bytes();
  }
  header.list_hash = XXH3_64bits(list, list_bytes);
  header.values_hash = XXH3_64bits(values, value_bytes);
  header.payload_hash = XXH3_64bits(values + value_bytes, other_bytes);
  header.header_hash = hash_of_header(header);
  std::memcpy(record.data(), &header, sizeof header);
  return record;
}

std::uint64_t frame_bytes(const sampling::TileResult& tile) {
  return sizeof(TileHeader) + sizeof(ArrayEntry) * arrays_of(tile).size();
}

std::string fault_of(const TileHeader& header, const TileDemands& demands) {
  if (std::memcmp(header.magic, kMagic, sizeof header.magic) != 0 ||
      header.header_hash != hash_of_header(header))
    return "its header is damaged";
  if (header.byte_order != kByteOrder) return "it was written on a machine of another byte order";
  if (header.format != kRecordFormat) return "it is of another format";
  if (header.run != demands.run) return "it belongs to another run";
  const bool in_grid = header.index < demands.grid.size();
  const sampling::PixelRect position = in_grid ? demands.grid[header.index] : sampling::PixelRect{};
  if (!in_grid || header.x0 != position.x0 || header.y0 != position.y0 || header.x1 != position.x1 ||
      header.y1 != position.y1 || header.columns != demands.columns)
    return "it does not fit the image";
  return {};
}

std::string decode_tile(const TileHeader& header, std::span<const std::byte> payload,
                        const ReadValues& read_values, sampling::TileResult& tile) {
  const std::string wrong = format("the checksum of tile {} is wrong", header.index);
  if (payload.size() != header.payload_bytes) return wrong;
  const ArrayList list(header, payload);
  if (!list.whole()) return wrong;
  std::span<const std::byte> values, others = list.arrays();
  std::vector<std::byte> unpacked;
  if (header.values_in_cubes != 0) {
    if (ZSTD_getFrameContentSize(others.data(), others.size()) != list.other_bytes()) return wrong;
    unpacked.resize(list.other_bytes());
    if (ZSTD_decompress(unpacked.data(), unpacked.size(), others.data(), others.size()) != unpacked.size())
      return wrong;
    others = unpacked;
  } else {
    values = others.first(list.value_bytes());
    others = others.subspan(values.size());
    if (XXH3_64bits(values.data(), values.size()) != header.values_hash) return wrong;
  }
  if (XXH3_64bits(others.data(), others.size()) != header.payload_hash) return wrong;
  tile = {};
  tile.tile = header.rect();
  tile.columns = header.columns;
  for (const ArrayEntry& entry : list.entries()) {
    void* const to = make_room(entry, tile);
    if (to == nullptr) return "it is of another format";
    if (ArrayList::is_value(entry) && header.values_in_cubes != 0) continue;
    std::span<const std::byte>& from = ArrayList::is_value(entry) ? values : others;
    std::memcpy(to, from.data(), entry.bytes());
    from = from.subspan(entry.bytes());
  }
  if (!tile.fault().empty()) return "it does not fit the image";
  if (header.values_in_cubes != 0 &&
      (!read_values || !read_values(tile, [&] { return hash_of_values(tile) == header.values_hash; })))
    return format("the values of tile {} are in the cubes no more", header.index);
  tile.halo_samples = header.halo_samples;
  tile.pilot_samples = header.pilot_samples;
  tile.probe_samples = header.probe_samples;
  tile.rays = {header.primary_rays, header.shadow_rays, header.continuation_rays};
  return {};
}

std::vector<std::byte> without_values(const TileHeader& header, std::span<const std::byte> payload) {
  const ArrayList list(header, payload);
  if (header.values_in_cubes != 0 || !list.whole()) return {};
  const std::span<const std::byte> entries = payload.first(payload.size() - list.arrays().size()),
                                   others = list.arrays().subspan(list.value_bytes());
  constexpr int kLevel = 1;  // the quickest
  const std::size_t before = sizeof header + entries.size();
  std::vector<std::byte> record(before + ZSTD_compressBound(others.size()));
  const std::size_t packed =
      ZSTD_compress(record.data() + before, record.size() - before, others.data(), others.size(), kLevel);
  if (ZSTD_isError(packed) != 0) return {};
  record.resize(before + packed);
  TileHeader rest = header;
  rest.values_in_cubes = 1;
  rest.payload_bytes = entries.size() + packed;
  rest.header_hash = hash_of_header(rest);
  std::memcpy(record.data(), &rest, sizeof rest);
  std::memcpy(record.data() + sizeof rest, entries.data(), entries.size());
  return record;
}

}  // namespace ifov::io
