#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/files/own_files.h"
#include "io/scene_cache/file_stamp.h"

namespace ifov::io {

/// What a cache begins with; records follow, then a table of them. The first hash is of everything behind the header,
/// by blocks, the second of the header before it.
struct CacheHeader {
  char magic[8];
  std::uint32_t byte_order, format;
  std::uint64_t file_bytes, table_offset;
  std::uint64_t reserved[2];
  std::uint64_t content_hash, header_hash;
};
static_assert(sizeof(CacheHeader) == 64);

inline constexpr char kCacheMagic[9] = "IFOVCACH";
inline constexpr std::uint32_t kCacheByteOrder = 0x01020304, kCacheFormat = 2;
inline constexpr std::size_t kCacheAlignment = 64;

/// XXH3, 64 bits.
std::uint64_t cache_hash(std::span<const std::byte> bytes);

/// The hash of the hashes of all blocks of 1 MiB (the last may be shorter), which are worked out in parallel.
inline constexpr std::size_t kHashedBlock_bytes = 1 << 20;
std::uint64_t hash_of_blocks(std::span<const std::byte> bytes);

/// Writes a cache beside its final name, under one that no other run has, and renames it when it is whole. Throws
/// SystemError where it cannot.
class CacheWriter {
 public:
  explicit CacheWriter(const std::filesystem::path& path);
  /// Removes what was not published.
  ~CacheWriter();
  CacheWriter(const CacheWriter&) = delete;
  CacheWriter& operator=(const CacheWriter&) = delete;

  void add(const std::string& name, const std::vector<FileStamp>& made_from,
           std::span<const std::span<const std::byte>> pieces);
  void publish(const std::string& program_version);

 private:
  struct Hash;
  void write(std::span<const std::byte> bytes);
  void align();

  NewFile file_;
  std::unique_ptr<Hash> hash_;
  std::uint64_t offset_ = sizeof(CacheHeader);
  std::uint64_t records_ = 0;
  std::string table_;
};

/// Numbers and texts of a table, one behind the other; texts after their length.
void append_number(std::string& table, std::uint64_t value);
void append_text(std::string& table, const std::string& text);

}  // namespace ifov::io
