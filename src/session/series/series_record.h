#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ifov::session {

/// Which runs make up a series: NAME_series.json in its folder, written before the first of them and again after the last.
struct SeriesRecord {
  struct One {
    std::string time, folder;
  };
  std::string version, document;  ///< of the program; the document's path
  std::string name = "image";     ///< of the products
  std::vector<One> times;
  bool complete = false;           ///< all are made, and the products of the series
  std::vector<std::string> files;  ///< these, by name

  /// In a folder; nothing where it holds no series. SystemError where it cannot be read, or makes no sense.
  static std::optional<SeriesRecord> in(const std::filesystem::path& folder);
  void write(const std::filesystem::path& folder) const;
};

/// The record of a run in the folder of a time, with this name; nothing where the run is not complete.
std::optional<std::filesystem::path> complete_run(const std::filesystem::path& folder,
                                                  const std::string& name);

}  // namespace ifov::session
