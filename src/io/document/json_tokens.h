#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>

#include "io/document/document_source.h"
#include "io/document/json_adapter.h"

namespace ifov::io {

/// What the JSON library does not tell or does not check.
struct JsonTokens {
  std::unordered_map<std::size_t, std::size_t> key_of_value;  ///< offset of a value -> offset of its key
  std::size_t end = 0;     ///< offset just behind the last token
  std::string still_open;  ///< the lists and objects that do not end, for people; empty: none
};

/// Reads the tokens of a JSON text strictly (UTF-8, numbers, escapes, control characters, depth, count of
/// values), which JsonCpp is lenient about. How tokens are put together is left to JsonCpp. Throws
/// InputError, also for a text that ends within a token.
JsonTokens scan_json(const DocumentSource& source, const JsonRules& rules);

}  // namespace ifov::io
