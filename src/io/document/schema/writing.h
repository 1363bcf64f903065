#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/json/json_value.h"

namespace ifov::io {

/// Where and how a document is written.
struct Writing {
  std::string folder;                      ///< of the document: files are named from there
  bool all_keys = false;                   ///< those with their defaults too
  std::vector<std::string> sections = {};  ///< keys of the document itself that are written; empty: all

  /// The path of keys to what could not be written, from the inside outwards; empty: nothing was found yet.
  std::string fault = {};

  /// The fault is within the member of this key, or the item of this index.
  void is_within(std::string_view key);
  void is_within(std::size_t index);
};

/// Nothing for a value that a kind cannot tell.
using Written = std::optional<JsonValue>;

/// The name of a file as a document in `folder` gives it.
std::string file_from(const std::string& folder, const std::string& path);

}  // namespace ifov::io
