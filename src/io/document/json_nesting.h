#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/document/document_source.h"

namespace ifov::io {

/// The lists and objects of a JSON text that have begun and not ended, to say where a text that is cut short
/// ends.
class JsonNesting {
 public:
  explicit JsonNesting(const DocumentSource& source) : source_(source) {}

  std::size_t depth() const { return open_.size(); }

  /// `key`: of the list or object that begins here, in an object; a piece of the source.
  void begin(std::size_t offset, bool is_list, std::string_view key);
  void end();
  void next_item();

  /// "the list 'a.b[3]' that begins at 1:20; still to close: ]]}"; empty where nothing is open. `closing`:
  /// what has to be closed before.
  std::string still_open(std::string closing = {}) const;

  /// "line:column"
  std::string place(std::size_t offset) const;

 private:
  struct Open {
    std::size_t offset = 0;
    bool is_list = false;
    std::string_view key;   ///< in an object
    std::size_t items = 0;  ///< of a list, that have ended
  };

  const DocumentSource& source_;
  std::vector<Open> open_;
};

}  // namespace ifov::io
