#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace ifov::io {

/// The text of a document and where its lines begin. Columns count characters (UTF-8 code points) from 1.
class DocumentSource {
 public:
  DocumentSource(std::string text, std::string file_name);

  const std::string& text() const { return text_; }
  const std::string& file_name() const { return file_name_; }

  SourcePosition position(std::size_t offset) const;

  /// A path as written in the document, made relative to the working directory instead of the document's
  /// folder.
  std::string resolve(std::string_view path) const;

  /// "file:line:column: message", then the line and a caret under the column.
  InputError error(const SourcePosition& position, std::string_view message) const;

 private:
  std::size_t characters_before(std::size_t offset) const;

  std::string text_;
  std::string file_name_;
  std::vector<std::size_t> line_starts_;
  std::vector<std::size_t> characters_;  ///< of the text before every kStride-th byte: a file may be one line
};

/// The same for a text without an index of its lines.
InputError located_error(std::string_view text, const std::string& file_name, const SourcePosition& position,
                         std::string_view message);

}  // namespace ifov::io
