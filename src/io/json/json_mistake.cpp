#include "io/json/json_mistake.h"

#include <algorithm>

#include "core/format.h"

namespace ifov::io {
namespace {

using In = JsonMistake::In;

constexpr std::string_view kNoNumber = "this is not a number as JSON writes it (-12, 0.5, 1.5e-3)";
constexpr std::string_view kUnits =
    "this is not a number as JSON writes it; a value with a unit is a text: \"1.5 m\"";

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_of_number(char c) { return is_letter(c) || is_digit(c) || c == '-' || c == '+' || c == '.'; }

class Explanation {
 public:
  Explanation(const JsonMistake& mistake, const std::string& text, const NodeBuilder& read)
      : mistake_(mistake), text_(text), read_(read), at_(mistake.offset) {}

  [[noreturn]] void give() const {
    if (mistake_.in == In::comment) fail_in_comment();
    if (mistake_.in == In::text || mistake_.in == In::escape) fail_in_text();
    const bool adjoins = mistake_.in != In::between || is_of_number(peek(at_));
    const std::size_t begin = adjoins ? beginning() : at_;
    const bool is_number = begin < text_.size() && (is_digit(text_[begin]) || text_[begin] == '-');
    const bool within = mistake_.in == In::number || (mistake_.in == In::value && begin < at_);
    const std::string open = read_.still_open();
    if (at_ == text_.size() && !open.empty()) {
      if (within) fail_at_end(begin, "value", "");
      const std::size_t end = text_.find_last_not_of(" \t\r\n") + 1;
      read_.fail(end, format("the file ends here, within {}", open));
    }
    if (is_number && within) read_.fail(begin, kNoNumber);
    if (is_number && begin < at_)
      read_.fail(begin, is_digit(peek(at_)) ? "a number must not begin with 0 and another digit" : kUnits);
    if (begin < text_.size() && !is_number) fail_at_word(begin);
    read_.fail(at_, mistake_.expected);
  }

 private:
  char peek(std::size_t at) const { return at < text_.size() ? text_[at] : '\0'; }

  /// Of the number or word that the mistake is in or follows without a gap.
  std::size_t beginning() const {
    std::size_t begin = at_;
    while (begin > 0 && is_of_number(text_[begin - 1])) --begin;
    return begin;
  }

  /// For a text that ends within the string or value that begins at `begin`.
  [[noreturn]] void fail_at_end(std::size_t begin, std::string_view what, const std::string& closing) const {
    const std::string around = read_.still_open(closing);
    read_.fail(text_.size(),
               format("the file ends here, within a {} that begins at {}{}", what, read_.position_text(begin),
                      around.empty() ? format("; still to close: {}", closing) : " in " + around));
  }

  [[noreturn]] void fail_in_text() const {
    const char c = peek(at_);
    // An escape may be cut as well, up to the last digit of a surrogate pair.
    const bool cut = text_.find_first_not_of("\\u0123456789abcdefABCDEF", at_) == std::string::npos;
    if (cut && text_.size() - at_ < std::string_view("\\ud83d\\ude00").size())
      fail_at_end(mistake_.text_begin, "text", "\"");
    if (mistake_.in == In::escape && c == '\\') read_.fail(at_, mistake_.expected);
    if (c == '\n' || c == '\r')
      read_.fail(mistake_.text_begin, "this text does not end on its line: '\"' is missing");
    read_.fail(at_, "a control character within a text; write it as \\t or \\u00XX");
  }

  // Between what was read and the mistake, slashes stand in comments alone.
  [[noreturn]] void fail_in_comment() const {
    std::size_t begin = text_.find('/', mistake_.known_end);
    for (;;) {
      const bool is_block = peek(begin + 1) == '*';
      if (!is_block && peek(begin + 1) != '/')
        read_.fail(begin, "unexpected '/'; a comment begins with '//' or '/*'");
      const std::size_t end = text_.find(is_block ? "*/" : "\n", begin + 2);
      if (end == std::string::npos) read_.fail(begin, "this comment does not end: '*/' is missing");
      begin = text_.find('/', end + (is_block ? 2 : 1));
    }
  }

  /// Returns where JSON has such a word or sign, only not here.
  void fail_at_word(std::size_t begin) const {
    std::size_t end = begin;
    while (is_letter(peek(end)) || is_digit(peek(end))) ++end;
    const std::string word = text_.substr(begin, end - begin);
    const char c = text_[begin];
    if (word == "true" || word == "false" || word == "null") return;
    if (!word.empty())
      read_.fail(begin, format("unexpected '{}'; texts and keys stand in double quotes: \"...\"", word));
    if (std::string_view("\"{}[],:").find(c) != std::string_view::npos) return;
    if (c == '\'') read_.fail(begin, "texts and keys stand in double quotes: \"...\"");
    if (c == '/') read_.fail(begin, "comments are not allowed here");
    const bool is_shown = c > 0x20 && c < 0x7F;
    read_.fail(begin, is_shown ? format("unexpected '{}'", c) : std::string("unexpected character"));
  }

  const JsonMistake& mistake_;
  const std::string& text_;
  const NodeBuilder& read_;
  std::size_t at_;
};

}  // namespace

void explain(const JsonMistake& mistake, const std::string& text, const NodeBuilder& read) {
  Explanation(mistake, text, read).give();
}

}  // namespace ifov::io
