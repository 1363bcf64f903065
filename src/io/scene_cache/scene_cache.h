#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "io/files/mapped_file.h"
#include "io/scene_cache/file_stamp.h"

namespace ifov::io {

class CacheWriter;

/// What was worked out from a scene's files, kept in one file beside the document: records of bytes by name, each
/// with the files that it was made from (docs/formats/scene_cache.md). What is damaged, of another version or older
/// than its files is as good as absent, which the log is told. Where nothing can be written the cache does without.
/// Serves one thread.
class SceneCache {
 public:
  /// Opens `path` if it is there and checks every byte of it. `log` may be null.
  SceneCache(std::filesystem::path path, std::string program_version, LogSink* log);
  ~SceneCache();
  SceneCache(const SceneCache&) = delete;
  SceneCache& operator=(const SceneCache&) = delete;

  /// The bytes of a record whose files are still what they were, aligned to 64; they live as long as this
  /// or its keeper.
  std::optional<std::span<const std::byte>> find(const std::string& name);

  /// Keeps the bytes that are found.
  std::shared_ptr<const void> keeper() const { return file_; }

  /// How a file is called in names of records: relative to the folder of the cache.
  std::string name_of(const std::string& file) const;

  /// The stamps of files that are about to be read.
  std::vector<FileStamp> stamps(std::span<const std::string> files) const;

  /// The stamps of all files whose records were found or put.
  std::vector<FileStamp> known_files() const;

  /// Keeps a record, made of pieces one behind the other. It is found by the next program.
  void put(const std::string& name, std::vector<FileStamp> made_from,
           std::span<const std::span<const std::byte>> pieces);

  /// The same in place of a record that was found.
  void replace(const std::string& name, std::vector<FileStamp> made_from,
               std::span<const std::span<const std::byte>> pieces);

  /// A record that was found makes no sense to its reader: the log is told, and it is not kept.
  void reject(const std::string& name);

  /// Gives the file its name, if anything is new in it. Records that were neither found nor put are dropped.
  void save();

 private:
  struct Record {
    std::string name;
    std::vector<FileStamp> made_from;
    std::span<const std::byte> bytes;
    bool found = false;
  };
  std::optional<std::string> open();  ///< what is wrong with the file, if anything
  std::optional<std::string> read_table(std::span<const std::byte> table, std::size_t records_end);
  CacheWriter* writer();
  void say(const std::string& message) const;

  std::filesystem::path path_;
  std::string program_version_;
  LogSink* log_;
  std::shared_ptr<const MappedFile> file_;
  std::vector<Record> records_;
  std::unique_ptr<CacheWriter> writer_;
  std::vector<FileStamp> put_;  ///< of the files of records that were put
  bool cannot_write_ = false, dirty_ = false;
};

}  // namespace ifov::io
