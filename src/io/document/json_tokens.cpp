#include "io/document/json_tokens.h"

#include <string_view>

#include "core/format.h"

namespace ifov::io {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

class Scanner {
 public:
  Scanner(const DocumentSource& source, const JsonRules& rules)
      : source_(source), text_(source.text()), rules_(rules) {}

  JsonTokens scan() {
    if (text_.size() > rules_.max_bytes) {
      throw source_.error(
          {}, format("the document has {} bytes, more than the {} allowed", text_.size(), rules_.max_bytes));
    }
    check_utf8();
    while (skip_space(), at_ < text_.size()) token();
    return std::move(tokens_);
  }

 private:
  [[noreturn]] void fail(std::size_t offset, std::string_view message) const {
    throw source_.error(source_.position(offset), message);
  }

  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  // RFC 3629: no overlong forms, no surrogates, nothing beyond U+10FFFF.
  void check_utf8() const {
    const auto byte = [&](std::size_t i) {
      return i < text_.size() ? static_cast<unsigned char>(text_[i]) : 0U;
    };
    std::size_t i = 0;
    while (i < text_.size()) {
      const unsigned lead = byte(i), second = byte(i + 1);
      std::size_t length = 0;
      if (lead < 0x80) {
        length = 1;
      } else if (lead >= 0xC2 && lead <= 0xDF) {
        length = 2;
      } else if (lead >= 0xE0 && lead <= 0xEF && !(lead == 0xE0 && second < 0xA0) &&
                 !(lead == 0xED && second > 0x9F)) {
        length = 3;
      } else if (lead >= 0xF0 && lead <= 0xF4 && !(lead == 0xF0 && second < 0x90) &&
                 !(lead == 0xF4 && second > 0x8F)) {
        length = 4;
      }
      bool valid = length > 0;
      for (std::size_t k = 1; k < length; ++k) valid = valid && (byte(i + k) & 0xC0U) == 0x80U;
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
      if (c != ',') --depth_;
      ++at_;
      return;
    }
    if (++values_ > rules_.max_values) {
      fail(begin, format("the document has more than {} values", rules_.max_values));
    }
    if (has_key) tokens_.key_of_value.emplace(begin, key);
    if (c == '{' || c == '[') {
      if (++depth_ > rules_.max_depth) {
        fail(begin, format("lists and objects are nested more than {} deep", rules_.max_depth));
      }
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
      if (at_ >= text_.size()) fail(begin, "this text does not end: '\"' is missing");
      const auto byte = static_cast<unsigned char>(text_[at_]);
      if (byte == '"') break;
      if (byte == '\n' || byte == '\r') fail(begin, "this text does not end on its line: '\"' is missing");
      if (byte < 0x20) fail(at_, "a control character within a text; write it as \\t or \\u00XX");
      if (byte == '\\') escape();
    }
    ++at_;
  }

  void escape() {
    const std::size_t begin = at_++;
    const char c = peek();
    if (c == 'u') {
      const unsigned code = code_unit(begin);
      const bool leads = code >= 0xD800 && code <= 0xDBFF;
      bool paired = code < 0xD800 || code > 0xDFFF;
      if (leads && peek(1) == '\\' && peek(2) == 'u') {
        at_ += 2;
        const unsigned second = code_unit(begin);
        paired = second >= 0xDC00 && second <= 0xDFFF;
      }
      if (!paired) fail(begin, "half of a surrogate pair; both halves must be written");
    } else if (c == '\0' || std::string_view("\"\\/bfnrt").find(c) == std::string_view::npos) {
      fail(begin, "unknown escape; a backslash itself is written '\\\\'");
    }
  }

  // From the 'u' of an escape to its last digit.
  unsigned code_unit(std::size_t begin) {
    unsigned code = 0;
    for (std::size_t k = 1; k <= 4; ++k) {
      const char c = peek(k);
      if (!is_hex(c)) fail(begin, "'\\u' needs four hexadecimal digits");
      code = 16 * code + static_cast<unsigned>(is_digit(c) ? c - '0' : (c | 0x20) - 'a' + 10);
    }
    at_ += 4;
    return code;
  }

  void digits(std::size_t begin) {
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
    if (found == "true" || found == "false" || found == "null") return;
    if (found.empty()) {
      const auto byte = static_cast<unsigned char>(text_[begin]);
      if (byte == '\'') fail(begin, "texts and keys stand in double quotes: \"...\"");
      if (text_.compare(begin, 3, "\xEF\xBB\xBF") == 0) fail(begin, "the text begins with a byte order mark");
      fail(begin, byte > 0x20 && byte < 0x7F ? format("unexpected '{}'", static_cast<char>(byte))
                                             : std::string("unexpected character"));
    }
    fail(begin, format("unexpected '{}'; texts and keys stand in double quotes: \"...\"", found));
  }

  const DocumentSource& source_;
  std::string_view text_;
  const JsonRules& rules_;
  std::size_t at_ = 0, values_ = 0;
  int depth_ = 0;
  bool last_was_text_ = false, has_pending_key_ = false;
  std::size_t last_text_ = 0, pending_key_ = 0;
  JsonTokens tokens_;
};

}  // namespace

JsonTokens scan_json(const DocumentSource& source, const JsonRules& rules) {
  return Scanner(source, rules).scan();
}

}  // namespace ifov::io
