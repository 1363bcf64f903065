#pragma once

#include <filesystem>
#include <string>

#include "io/json/json_view.h"

namespace ifov::session {

using Record = io::JsonView;

/// The record of a run (NAME_run.json).
class RunRecordFile {
 public:
  /// SystemError where it cannot be read, InputError where it is none.
  explicit RunRecordFile(const std::filesystem::path& path);
  Record root() const { return Record(tree_); }

 private:
  io::DocumentTree tree_;
};

/// For messages that a folder holds no run: "; its folders 'oli' and 'tirs' hold runs", or nothing.
std::string where_runs_are(const std::filesystem::path& folder);

}  // namespace ifov::session
