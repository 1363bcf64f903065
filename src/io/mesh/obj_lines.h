#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace ifov::io {

/// A piece of a line between blanks, and its column from 1.
struct ObjWord {
  std::string_view text;
  int column = 0;
};

/// The statements of an OBJ file one after another: lines without comments; a backslash at the end of a line
/// joins the next one to it.
class ObjLines {
 public:
  /// Throws SystemError where the file cannot be read.
  explicit ObjLines(const std::filesystem::path& path);

  bool next();              ///< steps to the next statement; false at the end
  ObjWord word();           ///< the next word of the statement; empty at its end
  std::string_view rest();  ///< what is left of the statement, without blanks around it

  /// Throws an InputError that shows the place: "file:line:column: message", the line, a caret.
  [[noreturn]] void fail(int column, const std::string& message) const;

 private:
  std::string name_;
  std::string text_;
  std::size_t at_ = 0;  ///< start of the next line
  int line_ = 0;        ///< number of the statement's first line
  int lines_read_ = 0;
  std::string joined_;  ///< a statement made of several lines
  std::string_view statement_;
  std::size_t in_statement_ = 0;
};

/// The number that is the whole of a word, if it is one and finite; a leading plus is allowed.
std::optional<double> obj_number(std::string_view word);

}  // namespace ifov::io
