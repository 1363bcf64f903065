#include "io/scene_cache/scene_cache.h"

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "io/scene_cache/cache_writer.h"

namespace ifov::io {
namespace {

/// Reads a table front to back; `good` is false once anything reached beyond its end.
class TableReader {
 public:
  explicit TableReader(std::span<const std::byte> table) : rest_(table) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    if (rest_.size() < sizeof value) {
      good_ = false;
      rest_ = {};
      return 0;
    }
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_ = rest_.subspan(sizeof value);
    return value;
  }
  std::string text() {
    const std::uint64_t length = number();
    if (length > rest_.size()) {
      good_ = false;
      return {};
    }
    std::string value(reinterpret_cast<const char*>(rest_.data()), length);
    rest_ = rest_.subspan(length);
    return value;
  }
  /// A count of things that take at least `bytes` each.
  std::uint64_t count(std::size_t bytes) {
    const std::uint64_t value = number();
    if (value > rest_.size() / bytes) good_ = false;
    return good_ ? value : 0;
  }
  bool good() const { return good_; }
  bool at_end() const { return good_ && rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
  bool good_ = true;
};

}  // namespace

SceneCache::SceneCache(std::filesystem::path path, std::string program_version, LogSink* log)
    : path_(std::move(path)), program_version_(std::move(program_version)), log_(log) {
  constexpr int kAttempts = 5;  // another run may take the file away to put its own there
  std::error_code ignored;
  std::optional<std::string> wrong;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (!std::filesystem::exists(path_, ignored)) return;
    wrong = open();
    if (!wrong) return;
    if (file_) break;
  }
  say(format("the scene cache '{}' is not used: {}; the scene is read from its files", path_.string(),
             *wrong));
  records_.clear();
  file_.reset();
  dirty_ = true;
}

SceneCache::~SceneCache() = default;

void SceneCache::say(const std::string& message) const {
  if (log_ != nullptr) log_->info(message);
}

std::optional<std::string> SceneCache::open() {
  try {
    file_ = std::make_shared<const MappedFile>(path_);
  } catch (const SystemError& error) {
    return error.what();
  }
  const std::span<const std::byte> bytes = file_->bytes();
  CacheHeader header;
  if (bytes.size() < sizeof header) return "it is damaged";
  std::memcpy(&header, bytes.data(), sizeof header);
  if (std::memcmp(header.magic, kCacheMagic, sizeof header.magic) != 0 ||
      header.header_hash != cache_hash(bytes.first(offsetof(CacheHeader, header_hash))))
    return "it is damaged";
  if (header.byte_order != kCacheByteOrder) return "it was written on a machine of another byte order";
  if (header.format != kCacheFormat) return "it is of another format";
  if (header.file_bytes != bytes.size() || header.table_offset < sizeof header ||
      header.table_offset > bytes.size() ||
      header.content_hash != hash_of_blocks(bytes.subspan(sizeof header)))
    return "it is damaged";
  return read_table(bytes.subspan(header.table_offset), header.table_offset);
}

std::optional<std::string> SceneCache::read_table(std::span<const std::byte> table, std::size_t records_end) {
  TableReader reader(table);
  const std::string version = reader.text();
  if (reader.good() && version != program_version_)
    return format("it was written by version {}", version.substr(0, 40));
  const std::uint64_t count = reader.count(4 * sizeof(std::uint64_t));
  for (std::uint64_t k = 0; k < count && reader.good(); ++k) {
    Record record;
    record.name = reader.text();
    const std::uint64_t offset = reader.number(), size = reader.number();
    const std::uint64_t stamps = reader.count(5 * sizeof(std::uint64_t));
    for (std::uint64_t s = 0; s < stamps && reader.good(); ++s) {
      FileStamp stamp;
      stamp.path = reader.text();
      stamp.bytes = reader.number();
      stamp.time_ns = static_cast<std::int64_t>(reader.number());
      stamp.hash[0] = reader.number(), stamp.hash[1] = reader.number();
      record.made_from.push_back(std::move(stamp));
    }
    if (offset > records_end || size > records_end - offset || offset % kCacheAlignment != 0)
      return "it is damaged";
    record.bytes = file_->bytes().subspan(offset, size);
    records_.push_back(std::move(record));
  }
  if (!reader.at_end()) return "it is damaged";
  return std::nullopt;
}

std::optional<std::span<const std::byte>> SceneCache::find(const std::string& name) {
  for (Record& record : records_) {
    if (record.name != name) continue;
    for (FileStamp& stamp : record.made_from) {
      const StampState state = check_stamp(stamp, path_.parent_path());
      if (state == StampState::changed) {
        say(format("'{}' has changed since '{}' was written: it is read again", stamp.path, path_.string()));
        dirty_ = true;
        return std::nullopt;
      }
      if (state == StampState::touched) dirty_ = true;
    }
    record.found = true;
    return record.bytes;
  }
  return std::nullopt;
}

void SceneCache::reject(const std::string& name) {
  say(format("'{}' in the scene cache '{}' makes no sense: it is read again", name, path_.string()));
  dirty_ = true;
  for (Record& record : records_)
    if (record.name == name) record.found = false;
}

std::string SceneCache::name_of(const std::string& file) const {
  return name_beside(file, path_.parent_path());
}

std::vector<FileStamp> SceneCache::stamps(std::span<const std::string> files) const {
  std::vector<FileStamp> found;
  if (cannot_write_) return found;
  for (const std::string& file : files) found.push_back(stamp_of(file, path_.parent_path()));
  return found;
}

std::vector<FileStamp> SceneCache::known_files() const {
  std::vector<FileStamp> known = put_;
  for (const Record& record : records_)
    if (record.found) known.insert(known.end(), record.made_from.begin(), record.made_from.end());
  return known;
}

CacheWriter* SceneCache::writer() {
  if (!writer_ && !cannot_write_) try {
      writer_ = std::make_unique<CacheWriter>(path_);
    } catch (const SystemError& error) {
      cannot_write_ = true;
      say(format("there will be no scene cache: {}", error.what()));
    }
  return writer_.get();
}

void SceneCache::put(const std::string& name, std::vector<FileStamp> made_from,
                     std::span<const std::span<const std::byte>> pieces) {
  if (writer() == nullptr) return;
  try {
    writer_->add(name, made_from, pieces);
    put_.insert(put_.end(), made_from.begin(), made_from.end());
  } catch (const SystemError& error) {
    writer_.reset();
    cannot_write_ = true;
    say(format("there will be no scene cache: {}", error.what()));
  }
}

void SceneCache::replace(const std::string& name, std::vector<FileStamp> made_from,
                         std::span<const std::span<const std::byte>> pieces) {
  std::erase_if(records_, [&](const Record& record) { return record.name == name; });
  put(name, std::move(made_from), pieces);
}

void SceneCache::save() {
  const bool dropped =
      std::any_of(records_.begin(), records_.end(), [](const Record& r) { return !r.found; });
  const bool any = std::any_of(records_.begin(), records_.end(), [](const Record& r) { return r.found; });
  if (!writer_ && !(any && (dirty_ || dropped))) return;
  if (writer() == nullptr) return;
  try {
    for (const Record& record : records_)
      if (record.found) writer_->add(record.name, record.made_from, std::span(&record.bytes, 1));
    writer_->publish(program_version_);
  } catch (const SystemError& error) {
    cannot_write_ = true;
    say(format("there will be no scene cache: {}", error.what()));
  }
  writer_.reset();
  dirty_ = false;
}

}  // namespace ifov::io
