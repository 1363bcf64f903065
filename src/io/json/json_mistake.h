#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/json/node_builder.h"

namespace ifov::io {

/// Where the library stopped to read a JSON text, and what it would have needed there.
struct JsonMistake {
  enum class In { between, value, number, text, escape, comment };

  In in = In::between;  ///< what it was in: between values and signs, or in one of them
  std::size_t offset = 0;
  std::string_view expected{};  ///< in words
  std::size_t text_begin = 0;   ///< of the last text or key that began
  std::size_t known_end = 0;    ///< behind the last value or key that was read
};

/// Throws InputError for people: at the beginning of the token that is wrong, or with what is still open where the text ends
/// too early.
[[noreturn]] void explain(const JsonMistake& mistake, const std::string& text, const NodeBuilder& read);

}  // namespace ifov::io
