#include "io/run_state/tile_packs.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "core/error.h"
#include "io/products/part_file.h"
#include "io/run_state/tile_store.h"

namespace ifov::io {
namespace {

/// A pack front to back.
class PackReader {
 public:
  explicit PackReader(const std::filesystem::path& pack)
      : path_(pack), file_(pack, std::ios::binary | std::ios::ate) {
    if (!file_) throw SystemError(format("{}: cannot be read: {}", pack.string(), std::strerror(errno)));
    size_ = static_cast<std::uint64_t>(file_.tellg());
    file_.seekg(0);
  }
  std::uint64_t position() const { return position_; }
  std::uint64_t left() const { return size_ - position_; }
  void read(void* to, std::uint64_t bytes) {
    file_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
    if (!file_) throw SystemError(format("{}: cannot be read at byte {}", path_.string(), position_));
    position_ += bytes;
  }
  void skip(std::uint64_t bytes) {
    position_ += bytes;
    file_.seekg(static_cast<std::streamoff>(position_));
  }

 private:
  std::filesystem::path path_;
  std::ifstream file_;
  std::uint64_t size_ = 0, position_ = 0;
};

/// Whole records that lie at [begin, end) of a damaged pack.
using Extent = std::pair<std::uint64_t, std::uint64_t>;

void keep_only(const std::filesystem::path& pack, const std::vector<Extent>& whole) {
  if (whole.empty()) {
    std::error_code ignored;
    std::filesystem::remove(pack, ignored);
    return;
  }
  PartFile repaired(pack);
  PackReader reader(pack);
  std::uint64_t offset = 0;
  for (const auto& [begin, end] : whole) {
    std::vector<std::byte> bytes(end - begin);
    reader.skip(begin - reader.position());
    reader.read(bytes.data(), bytes.size());
    repaired.write_at(offset, bytes.data(), bytes.size());
    offset += bytes.size();
  }
  repaired.sync();
  repaired.publish();
}

/// A link is none of ours: it could lead anywhere.
bool is_own(const std::filesystem::directory_entry& entry) {
  std::error_code unknown;
  return entry.symlink_status(unknown).type() == std::filesystem::file_type::regular;
}

}  // namespace

std::vector<std::filesystem::path> packs_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> packs;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == kPackEnding && is_own(*entry)) packs.push_back(entry->path());
  std::sort(packs.begin(), packs.end());
  return packs;
}

void read_pack(const std::filesystem::path& pack, const TileDemands& demands, const ReadValues& read_values,
               const std::function<void(const TileHeader&, const sampling::TileResult&)>& take, LogSink* log,
               bool repair) {
  std::vector<Extent> whole;
  bool damaged = false;
  const auto say = [&](const std::string& what) {
    damaged = true;
    if (log != nullptr) log->warn(format("{}: {}", pack.string(), what));
  };
  {
    PackReader reader(pack);
    if (reader.left() == 0) say("the file is empty: its tiles are computed again");
    std::vector<std::byte> payload;
    sampling::TileResult tile;
    while (reader.left() > 0) {
      const std::uint64_t begin = reader.position();
      TileHeader header;
      if (reader.left() < sizeof header) {
        say("the file is cut short: its last tile is computed again");
        break;
      }
      reader.read(&header, sizeof header);
      if (const std::string fault = fault_of(header, demands); !fault.empty()) {
        say(format("a tile is not taken, {}: it and what follows it in the file is computed again", fault));
        break;
      }
      if (header.payload_bytes > reader.left()) {
        say(format("the file is cut short: tile {} is computed again", header.index));
        break;
      }
      payload.resize(header.payload_bytes);
      reader.read(payload.data(), payload.size());
      if (const std::string fault = decode_tile(header, payload, read_values, tile); !fault.empty()) {
        say(format("{}: it is computed again", fault));
        continue;
      }
      whole.emplace_back(begin, reader.position());
      take(header, tile);
    }
  }
  if (damaged && repair) keep_only(pack, whole);
}

void move_values_out(const std::filesystem::path& pack, const TileDemands& demands) {
  std::vector<std::byte> rest, payload;
  PackReader reader(pack);
  for (TileHeader header; reader.left() >= sizeof header;) {
    reader.read(&header, sizeof header);
    if (!fault_of(header, demands).empty() || header.payload_bytes > reader.left()) return;
    payload.resize(header.payload_bytes);
    reader.read(payload.data(), payload.size());
    std::vector<std::byte> record = without_values(header, payload);
    if (record.empty()) {
      const auto* const bytes = reinterpret_cast<const std::byte*>(&header);
      record.assign(bytes, bytes + sizeof header);
      record.insert(record.end(), payload.begin(), payload.end());
    }
    rest.insert(rest.end(), record.begin(), record.end());
  }
  PartFile file(pack);
  try {
    file.write_at(0, rest.data(), rest.size());
    file.publish();
  } catch (...) {
    file.discard();
    throw;
  }
}

void read_headers(const std::filesystem::path& pack, const TileDemands& demands,
                  const std::function<void(const TileHeader&)>& take) {
  PackReader reader(pack);
  TileHeader header;
  while (reader.left() >= sizeof header) {
    reader.read(&header, sizeof header);
    if (!fault_of(header, demands).empty() || header.payload_bytes > reader.left()) return;
    take(header);
    reader.skip(header.payload_bytes);
  }
}

}  // namespace ifov::io
