#pragma once

#include <string>

#include "io/json/node.h"

namespace ifov::io {

struct JsonRules {
  bool comments = true;     ///< allow // and /* */
  bool unique_keys = true;  ///< a key twice in one object is an error; else both are members
  int max_depth = 64;       ///< nesting of lists and objects
  std::size_t max_bytes = 16U << 20U;
  std::size_t max_values = 2'000'000;
};

/// Parses JSON (RFC 8259, UTF-8, no trailing commas); a byte order mark at the start is dropped. Limits are checked before
/// memory is taken. Throws InputError with position and excerpt.
DocumentTree parse_json(std::string text, const std::string& file_name, const JsonRules& rules = {});

}  // namespace ifov::io
