#include "io/scene_cache/cache_writer.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstring>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "core/format.h"
#include "core/parallel.h"

namespace ifov::io {

/// hash_of_blocks() of bytes that come one after the other.
struct CacheWriter::Hash {
  XXH3_state_t state;
  std::size_t in_block = 0;
  std::vector<std::uint64_t> blocks;

  Hash() { XXH3_64bits_reset(&state); }
  void end_block() {
    blocks.push_back(XXH3_64bits_digest(&state));
    XXH3_64bits_reset(&state);
    in_block = 0;
  }
  void add(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const auto piece = bytes.first(std::min(bytes.size(), kHashedBlock_bytes - in_block));
      XXH3_64bits_update(&state, piece.data(), piece.size());
      in_block += piece.size();
      if (in_block == kHashedBlock_bytes) end_block();
      bytes = bytes.subspan(piece.size());
    }
  }
  std::uint64_t all() {
    if (in_block > 0) end_block();
    return cache_hash(std::as_bytes(std::span(blocks)));
  }
};

std::uint64_t cache_hash(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::uint64_t hash_of_blocks(std::span<const std::byte> bytes) {
  std::vector<std::uint64_t> blocks((bytes.size() + kHashedBlock_bytes - 1) / kHashedBlock_bytes);
  parallel_for(static_cast<std::int64_t>(blocks.size()), 0, [&](std::int64_t k) {
    const std::size_t begin = static_cast<std::size_t>(k) * kHashedBlock_bytes;
    blocks[static_cast<std::size_t>(k)] =
        cache_hash(bytes.subspan(begin, std::min(kHashedBlock_bytes, bytes.size() - begin)));
  });
  return cache_hash(std::as_bytes(std::span(blocks)));
}

void append_number(std::string& table, std::uint64_t value) {
  table.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_text(std::string& table, const std::string& text) {
  append_number(table, text.size());
  table += text;
}

namespace {

/// Several runs may write the cache of one document at once.
std::filesystem::path part_path_of(std::filesystem::path path) {
  static std::atomic<unsigned> count{0};
  return path += format(".{}-{}.part", getpid(), count++);
}

}  // namespace

CacheWriter::CacheWriter(const std::filesystem::path& path)
    : file_(path, part_path_of(path)), hash_(std::make_unique<Hash>()) {
  const CacheHeader empty{};
  file_.append(std::as_bytes(std::span(&empty, 1)));
}

CacheWriter::~CacheWriter() = default;

void CacheWriter::write(std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  hash_->add(bytes);
  file_.append(bytes);
  offset_ += bytes.size();
}

void CacheWriter::align() {
  static constexpr std::byte kZeros[kCacheAlignment] = {};
  write({kZeros, (kCacheAlignment - offset_ % kCacheAlignment) % kCacheAlignment});
}

void CacheWriter::add(const std::string& name, const std::vector<FileStamp>& made_from,
                      std::span<const std::span<const std::byte>> pieces) {
  align();
  const std::uint64_t begin = offset_;
  for (const std::span<const std::byte> piece : pieces) write(piece);
  append_text(table_, name);
  append_number(table_, begin);
  append_number(table_, offset_ - begin);
  append_number(table_, made_from.size());
  for (const FileStamp& stamp : made_from) {
    append_text(table_, stamp.path);
    append_number(table_, stamp.bytes);
    append_number(table_, static_cast<std::uint64_t>(stamp.time_ns));
    append_number(table_, stamp.hash[0]);
    append_number(table_, stamp.hash[1]);
  }
  ++records_;
}

void CacheWriter::publish(const std::string& program_version) {
  align();
  CacheHeader header{};
  std::memcpy(header.magic, kCacheMagic, sizeof header.magic);
  header.byte_order = kCacheByteOrder;
  header.format = kCacheFormat;
  header.table_offset = offset_;
  std::string head;
  append_text(head, program_version);
  append_number(head, records_);
  write(std::as_bytes(std::span(head)));
  write(std::as_bytes(std::span(table_)));
  header.file_bytes = offset_;
  header.content_hash = hash_->all();
  header.header_hash =
      cache_hash(std::as_bytes(std::span(&header, 1)).first(offsetof(CacheHeader, header_hash)));
  file_.write_head(std::as_bytes(std::span(&header, 1)));
  file_.publish();
}

}  // namespace ifov::io
