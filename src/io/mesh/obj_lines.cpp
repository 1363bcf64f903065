#include "io/mesh/obj_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/call_scope.h"
#include "core/error.h"
#include "io/files/input_file.h"

namespace ifov::io {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";

std::string_view without_end_blanks(std::string_view text) {
  const std::size_t last = text.find_last_not_of(kBlanks);
  return last == std::string_view::npos ? std::string_view{} : text.substr(0, last + 1);
}

}  // namespace

ObjLines::ObjLines(const std::filesystem::path& path) : name_(path.string()), text_(read_input(path)) {
  if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
  if (text_.starts_with("\xfe\xff") || text_.starts_with("\xff\xfe"))
    throw InputError(format("{}: the file is in UTF-16; expected plain text (UTF-8)", name_), {name_, 0, 0});
}

bool ObjLines::next() {
  stop_if_cancelled();
  in_statement_ = 0;
  joined_.clear();
  while (at_ < text_.size()) {
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    std::string_view line(text_.data() + at_, end - at_);
    at_ = std::min(text_.size(), std::string_view(text_).substr(end, 2) == "\r\n" ? end + 2 : end + 1);
    ++lines_read_;
    if (joined_.empty()) line_ = lines_read_;
    line = line.substr(0, line.find('#'));
    line = without_end_blanks(line);
    if (line.ends_with('\\')) {
      joined_.append(line.substr(0, line.size() - 1)).append(" ");
      continue;
    }
    if (!joined_.empty()) line = joined_.append(line);
    if (line.find_first_not_of(kBlanks) == std::string_view::npos) {
      joined_.clear();
      continue;
    }
    statement_ = line;
    return true;
  }
  if (joined_.find_first_not_of(kBlanks) == std::string::npos) return false;
  statement_ = joined_;  // the last line ended with a backslash
  return true;
}

ObjWord ObjLines::word() {
  const std::size_t begin = statement_.find_first_not_of(kBlanks, in_statement_);
  if (begin == std::string_view::npos) {
    in_statement_ = statement_.size();
    return {{}, static_cast<int>(statement_.size()) + 1};
  }
  in_statement_ = std::min(statement_.find_first_of(kBlanks, begin), statement_.size());
  return {statement_.substr(begin, in_statement_ - begin), static_cast<int>(begin) + 1};
}

std::string_view ObjLines::rest() {
  const std::size_t begin = statement_.find_first_not_of(kBlanks, in_statement_);
  in_statement_ = statement_.size();
  return begin == std::string_view::npos ? std::string_view{} : statement_.substr(begin);
}

void ObjLines::fail(int column, const std::string& message) const {
  constexpr std::size_t kShown = 100;
  const std::size_t from = column > 80 ? static_cast<std::size_t>(column) - 40 : 0;
  std::string excerpt(statement_.substr(std::min(from, statement_.size()), kShown));
  for (char& symbol : excerpt)
    if (symbol < ' ' || symbol > '~') symbol = symbol == '\t' ? ' ' : '?';
  const std::size_t caret = static_cast<std::size_t>(std::max(column, 1)) - 1 - from;
  throw InputError(
      format("{}:{}:{}: {}\n  {}\n  {}^", name_, line_, column, message, excerpt, std::string(caret, ' ')),
      {name_, line_, column});
}

std::optional<double> obj_number(std::string_view word) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
    if (word.starts_with('-')) return std::nullopt;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace ifov::io
