#include "io/document/json_tokens.h"

#include <optional>
#include <string>
#include <string_view>

#include "core/format.h"
#include "io/document/json_nesting.h"

namespace ifov::io {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

class Scanner {
 public:
  Scanner(const DocumentSource& source, const JsonRules& rules)
      : source_(source), text_(source.text()), rules_(rules), nesting_(source) {}

  JsonTokens scan() {
    if (text_.size() > rules_.max_bytes) {
      throw source_.error(
          {}, format("the document has {} bytes, more than the {} allowed", text_.size(), rules_.max_bytes));
    }
    check_utf8();
    while (skip_space(), at_ < text_.size()) {
      token();
      tokens_.end = at_;
    }
    if (cut_character_) fail(*cut_character_, "the text is not UTF-8 here");
    tokens_.still_open = nesting_.still_open();
    return std::move(tokens_);
  }

 private:
  [[noreturn]] void fail(std::size_t offset, std::string_view message) const {
    throw source_.error(source_.position(offset), message);
  }

  /// For a text that ends within the text or value that begins at `begin`.
  [[noreturn]] void fail_at_end(std::size_t begin, std::string_view what, const std::string& closing) const {
    const std::string around = nesting_.still_open(closing);
    fail(text_.size(),
         format("the file ends here, within a {} that begins at {}{}", what, nesting_.place(begin),
                around.empty() ? format("; still to close: {}", closing) : " in " + around));
  }

  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  // RFC 3629: no overlong forms, no surrogates, nothing beyond U+10FFFF.
  void check_utf8() {
    const auto byte = [&](std::size_t i) {
      return i < text_.size() ? static_cast<unsigned char>(text_[i]) : 0U;
    };
    std::size_t i = 0;
    while (i < text_.size()) {
      const unsigned lead = byte(i);
      const unsigned second = byte(i + 1);
      const auto second_within = [&](unsigned low, unsigned high) {
        return i + 1 == text_.size() || (second >= low && second <= high);
      };
      std::size_t length = 0;
      if (lead < 0x80) {
        length = 1;
      } else if (lead >= 0xC2 && lead <= 0xDF) {
        length = 2;
      } else if (lead >= 0xE0 && lead <= 0xEF && (lead != 0xE0 || second_within(0xA0, 0xBF)) &&
                 (lead != 0xED || second_within(0x80, 0x9F))) {
        length = 3;
      } else if (lead >= 0xF0 && lead <= 0xF4 && (lead != 0xF0 || second_within(0x90, 0xBF)) &&
                 (lead != 0xF4 || second_within(0x80, 0x8F))) {
        length = 4;
      }
      bool valid = length > 0;
      for (std::size_t k = 1; k < length && i + k < text_.size(); ++k)
        valid = valid && (byte(i + k) & 0xC0U) == 0x80U;
      if (valid && i + length > text_.size()) cut_character_ = i;
      if (!valid) fail(i, "the text is not UTF-8 here");
      i += length;
    }
  }

  void skip_space() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
        ++at_;
      } else if (c == '/') {
        comment();
      } else {
        return;
      }
    }
  }

  void comment() {
    const std::size_t begin = at_;
    if (!rules_.comments) fail(begin, "comments are not allowed here");
    if (peek(1) == '/') {
      const std::size_t end = text_.find('\n', at_);
      at_ = end == std::string_view::npos ? text_.size() : end + 1;
    } else if (peek(1) == '*') {
      const std::size_t end = text_.find("*/", at_ + 2);
      if (end == std::string_view::npos) fail(begin, "this comment does not end: '*/' is missing");
      at_ = end + 2;
    } else {
      fail(begin, "unexpected '/'; a comment begins with '//' or '/*'");
    }
  }

  void token() {
    const std::size_t begin = at_;
    const char c = peek();
    const std::size_t key = pending_key_;
    const bool has_key = has_pending_key_;
    if (c == ':') {
      ++at_;
      has_pending_key_ = last_was_text_;
      pending_key_ = last_text_;
      last_was_text_ = false;
      return;
    }
    has_pending_key_ = false;
    last_was_text_ = false;
    if (c == ',' || c == ']' || c == '}') {
      if (c != ',') nesting_.end();
      if (c == ',') nesting_.next_item();
      ++at_;
      return;
    }
    if (++values_ > rules_.max_values) {
      fail(begin, format("the document has more than {} values", rules_.max_values));
    }
    if (has_key) tokens_.key_of_value.emplace(begin, key);
    if (c == '{' || c == '[') {
      if (nesting_.depth() >= static_cast<std::size_t>(rules_.max_depth)) {
        fail(begin, format("lists and objects are nested more than {} deep", rules_.max_depth));
      }
      nesting_.begin(begin, c == '[',
                     has_key ? text_.substr(key + 1, text_.find('"', key + 1) - key - 1) : "");
      ++at_;
    } else if (c == '"') {
      string();
      last_was_text_ = true;
      last_text_ = begin;
    } else if (c == '-' || is_digit(c)) {
      number();
    } else {
      word();
    }
  }

  void string() {
    const std::size_t begin = at_++;
    for (;; ++at_) {
      if (at_ >= text_.size()) fail_at_end(begin, "text", "\"");
      const auto byte = static_cast<unsigned char>(text_[at_]);
      if (byte == '"') break;
      if (byte == '\n' || byte == '\r') fail(begin, "this text does not end on its line: '\"' is missing");
      if (byte < 0x20) fail(at_, "a control character within a text; write it as \\t or \\u00XX");
      if (byte == '\\') escape(begin);
    }
    ++at_;
  }

  void escape(std::size_t text_begin) {
    const auto must_go_on = [&](std::size_t ahead) {
      if (at_ + ahead >= text_.size()) fail_at_end(text_begin, "text", "\"");
    };
    const std::size_t begin = at_++;
    must_go_on(0);
    const char c = peek();
    if (c == 'u') {
      const unsigned code = code_unit(begin, must_go_on);
      const bool leads = code >= 0xD800 && code <= 0xDBFF;
      bool paired = code < 0xD800 || code > 0xDFFF;
      if (leads) must_go_on(1);
      if (leads && peek(1) == '\\') must_go_on(2);
      if (leads && peek(1) == '\\' && peek(2) == 'u') {
        at_ += 2;
        const unsigned second = code_unit(begin, must_go_on);
        paired = second >= 0xDC00 && second <= 0xDFFF;
      }
      if (!paired) fail(begin, "half of a surrogate pair; both halves must be written");
    } else if (c == '\0' || std::string_view("\"\\/bfnrt").find(c) == std::string_view::npos) {
      fail(begin, "unknown escape; a backslash itself is written '\\\\'");
    }
  }

  // From the 'u' of an escape to its last digit.
  unsigned code_unit(std::size_t begin, const auto& must_go_on) {
    unsigned code = 0;
    for (std::size_t k = 1; k <= 4; ++k) {
      must_go_on(k);
      const char c = peek(k);
      if (!is_hex(c)) fail(begin, "'\\u' needs four hexadecimal digits");
      code = 16 * code + static_cast<unsigned>(is_digit(c) ? c - '0' : (c | 0x20) - 'a' + 10);
    }
    at_ += 4;
    return code;
  }

  /// For a number or a word that cannot be whole.
  void fail_if_cut(std::size_t begin) const {
    if (at_ == text_.size() && nesting_.depth() > 0) fail_at_end(begin, "value", "");
  }

  void digits(std::size_t begin) {
    fail_if_cut(begin);
    if (!is_digit(peek())) fail(begin, "this is not a number as JSON writes it (-12, 0.5, 1.5e-3)");
    while (is_digit(peek())) ++at_;
  }

  void number() {
    const std::size_t begin = at_;
    if (peek() == '-') ++at_;
    if (peek() == '0' && is_digit(peek(1))) fail(begin, "a number must not begin with 0 and another digit");
    digits(begin);
    if (peek() == '.') {
      ++at_;
      digits(begin);
    }
    if (peek() == 'e' || peek() == 'E') {
      ++at_;
      if (peek() == '+' || peek() == '-') ++at_;
      digits(begin);
    }
    if (is_letter(peek()) || peek() == '.' || peek() == '-' || peek() == '+') {
      fail(begin, "this is not a number as JSON writes it; a value with a unit is a text: \"1.5 m\"");
    }
  }

  void word() {
    const std::size_t begin = at_;
    while (is_letter(peek()) || is_digit(peek())) ++at_;
    const std::string_view found = text_.substr(begin, at_ - begin);
    for (const std::string_view known : {"true", "false", "null"}) {
      if (found == known) return;
      if (!found.empty() && known.starts_with(found)) fail_if_cut(begin);
    }
    if (found.empty()) {
      const auto byte = static_cast<unsigned char>(text_[begin]);
      if (byte == '\'') fail(begin, "texts and keys stand in double quotes: \"...\"");
      fail(begin, byte > 0x20 && byte < 0x7F ? format("unexpected '{}'", static_cast<char>(byte))
                                             : std::string("unexpected character"));
    }
    fail(begin, format("unexpected '{}'; texts and keys stand in double quotes: \"...\"", found));
  }

  const DocumentSource& source_;
  std::string_view text_;
  const JsonRules& rules_;
  std::size_t at_ = 0, values_ = 0;
  JsonNesting nesting_;
  std::optional<std::size_t> cut_character_;  ///< a character whose last bytes lie beyond the end
  bool last_was_text_ = false, has_pending_key_ = false;
  std::size_t last_text_ = 0, pending_key_ = 0;
  JsonTokens tokens_;
};

}  // namespace

JsonTokens scan_json(const DocumentSource& source, const JsonRules& rules) {
  return Scanner(source, rules).scan();
}

}  // namespace ifov::io
