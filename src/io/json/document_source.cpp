#include "io/json/document_source.h"

#include <algorithm>
#include <filesystem>

#include "core/format.h"

namespace ifov::io {
namespace {

constexpr int kExcerptWidth = 100;
constexpr int kShownBeforeCaret = 70;
constexpr std::size_t kStride = 1024;

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

/// Characters of a line, each printable: control characters and broken UTF-8 become spaces and question
/// marks.
std::vector<std::string> printable_characters(std::string_view line) {
  std::vector<std::string> characters;
  for (const char c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if (!begins_character(c) && !characters.empty()) {
      characters.back() += c;
    } else if (byte < 0x20 || byte == 0x7F) {
      characters.emplace_back(" ");
    } else {
      characters.emplace_back(1, c);
    }
  }
  for (std::string& character : characters) {
    const auto lead = static_cast<unsigned char>(character[0]);
    const std::size_t expected = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 0;
    if (character.size() != expected) character.assign(1, '?');
  }
  return characters;
}

std::string_view line_of(std::string_view text, int line) {
  std::size_t begin = 0;
  for (int i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) return {};
    begin = end + 1;
  }
  std::string_view rest = text.substr(begin);
  rest = rest.substr(0, rest.find('\n'));
  if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
  return rest;
}

/// The piece of a line that `count` characters from the character `first` on make; the first bytes of a line that begins
/// within a character belong to none.
std::string_view piece_of(std::string_view line, int first, int count) {
  const auto skip = [&](std::size_t from, int characters) {
    for (; from < line.size(); ++from)
      if (begins_character(line[from]) && characters-- == 0) break;
    return from;
  };
  const std::size_t begin = skip(0, first), end = skip(begin, count);
  return line.substr(begin, end - begin);
}

/// The line with a caret below; a long line is cut to a window about the caret.
std::string excerpt(std::string_view line_text, const SourcePosition& position) {
  const int length = static_cast<int>(std::count_if(line_text.begin(), line_text.end(), begins_character));
  const int caret = std::clamp(position.column - 1, 0, length);
  int begin = 0;
  if (length > kExcerptWidth) begin = std::clamp(caret - kShownBeforeCaret, 0, length - kExcerptWidth);
  const int end = std::min(length, begin + kExcerptWidth);
  std::string shown = begin > 0 ? "..." : "";
  const std::size_t indent = static_cast<std::size_t>(caret - begin) + shown.size();
  for (const std::string& character : printable_characters(piece_of(line_text, begin, end - begin)))
    shown += character;
  if (end < length) shown += "...";
  const std::string number = format("{:>5}", position.line);
  return format("\n{} | {}\n{} | {}^", number, shown, std::string(number.size(), ' '),
                std::string(indent, ' '));
}

}  // namespace

DocumentSource::DocumentSource(std::string text, std::string file_name)
    : text_(std::move(text)), file_name_(std::move(file_name)), line_starts_{0} {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (i % kStride == 0) characters_.push_back(characters);
    characters += begins_character(text_[i]);
    if (text_[i] == '\n') line_starts_.push_back(i + 1);
  }
  characters_.push_back(characters);
}

std::size_t DocumentSource::characters_before(std::size_t offset) const {
  const std::size_t known = offset / kStride;
  const auto from = text_.begin() + static_cast<std::ptrdiff_t>(known * kStride);
  return characters_[known] +
         static_cast<std::size_t>(
             std::count_if(from, text_.begin() + static_cast<std::ptrdiff_t>(offset), begins_character));
}

SourcePosition DocumentSource::position(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const std::size_t start = *(after - 1);
  const std::size_t characters = characters_before(offset) - characters_before(start);
  return {file_name_, static_cast<int>(after - line_starts_.begin()), static_cast<int>(characters) + 1};
}

std::string DocumentSource::resolve(std::string_view path) const {
  const std::filesystem::path named(path);
  if (named.is_absolute()) return named.string();
  return (std::filesystem::path(file_name_).parent_path() / named).lexically_normal().string();
}

InputError DocumentSource::error(const SourcePosition& position, std::string_view message) const {
  return located_error(text_, file_name_, position, message);
}

InputError located_error(std::string_view text, const std::string& file_name, const SourcePosition& position,
                         std::string_view message) {
  const std::string& file = position.file.empty() ? file_name : position.file;
  if (position.line <= 0) return InputError(format("{}: {}", file, message), {file, 0, 0});
  std::string whole = format("{}:{}:{}: {}", file, position.line, position.column, message);
  if (file == file_name) whole += excerpt(line_of(text, position.line), position);
  return InputError(whole, position);
}

}  // namespace ifov::io
