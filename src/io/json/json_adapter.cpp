#include "io/json/json_adapter.h"

#include <rapidjson/reader.h>

#include <algorithm>

#include "core/format.h"
#include "io/json/json_mistake.h"
#include "io/json/node_builder.h"

namespace ifov::io {
namespace {

/// A text as RapidJSON reads it: a NUL ends it only where it ends. Strings are parsed "in situ", because only then does the
/// library tell where they begin; what they mean is put elsewhere, so that the text stays as it is.
class JsonStream {
 public:
  using Ch = char;

  explicit JsonStream(const std::string& text)
      : text_(text), decoded_(std::make_unique_for_overwrite<char[]>(text.size() + 1)) {}

  char Peek() const {
    const char c = text_[at_];
    return c == '\0' && at_ < text_.size() ? '\1' : c;
  }
  char Take() {
    const char c = Peek();
    if (at_ < text_.size()) ++at_;
    return c;
  }
  std::size_t Tell() const { return at_; }

  char* PutBegin() {
    if (at_ > 0 && text_[at_ - 1] == '"') string_begin_ = at_ - 1;  // numbers pass here too
    return put_ = decoded_.get();
  }
  void Put(char c) { *put_++ = c; }
  std::size_t PutEnd(const char* begin) const { return static_cast<std::size_t>(put_ - begin); }

  std::size_t string_begin() const { return string_begin_; }

 private:
  const std::string& text_;
  std::unique_ptr<char[]> decoded_;  ///< one string at a time, never longer than it is written
  char* put_ = nullptr;
  std::size_t at_ = 0, string_begin_ = 0;
};

/// Takes what is validated and needed no more.
struct Nowhere {
  void Put(char) {}
};

/// The library's events, with where the values begin.
class Events {
 public:
  using Ch = char;

  Events(const JsonStream& stream, const std::string& text, NodeBuilder& builder)
      : stream_(stream), text_(text), builder_(builder) {}

  bool Null() { return builder_.null(begin(4)), read(); }
  bool Bool(bool value) { return builder_.boolean(begin(value ? 4 : 5), value), read(); }
  bool RawNumber(const char*, unsigned length, bool) {
    return builder_.number(begin(length), std::string_view(text_).substr(begin(length), length)), read();
  }
  bool String(const char* value, unsigned length, bool) {
    return builder_.text(stream_.string_begin(), string({value, length})), read();
  }
  bool Key(const char* name, unsigned length, bool) {
    return builder_.key(stream_.string_begin(), string({name, length})), read();
  }
  // An iterative reader takes the bracket after the event.
  bool StartObject() { return builder_.begin(stream_.Tell(), false), read(); }
  bool StartArray() { return builder_.begin(stream_.Tell(), true), read(); }
  bool EndObject(unsigned) { return builder_.end(), read(); }
  bool EndArray(unsigned) { return builder_.end(), read(); }

  // With numbers as they are written, these do not come.
  bool Int(int) { return false; }
  bool Uint(unsigned) { return false; }
  bool Int64(std::int64_t) { return false; }
  bool Uint64(std::uint64_t) { return false; }
  bool Double(double) { return false; }

  std::size_t end_of_last() const { return end_of_last_; }

 private:
  std::size_t begin(std::size_t length) const { return stream_.Tell() - length; }
  bool read() {
    end_of_last_ = stream_.Tell();
    return true;
  }

  /// RapidJSON 1.1 takes the second half of a surrogate pair for a character of its own, which UTF-8 has not.
  std::string_view string(std::string_view value) const {
    for (std::size_t at = value.find('\xED'); at != std::string_view::npos; at = value.find('\xED', at + 1))
      if (static_cast<unsigned char>(value[at + 1]) >= 0xA0) fail_at_half();
    return value;
  }

  [[noreturn]] void fail_at_half() const {
    std::size_t at = stream_.string_begin();
    for (;;) {
      at = text_.find('\\', at);
      const char first = text_[at + 2] | 0x20, second = text_[at + 3] | 0x20;
      const bool is_surrogate =
          text_[at + 1] == 'u' && first == 'd' && second >= '8' && (second <= '9' || second >= 'a');
      if (is_surrogate && second >= 'c')
        builder_.fail(at, "half of a surrogate pair; both halves must be written");
      at += is_surrogate ? 12 : 2;
    }
  }

  const JsonStream& stream_;
  const std::string& text_;
  NodeBuilder& builder_;
  std::size_t end_of_last_ = 0;
};

struct Words {
  JsonMistake::In in;
  std::string_view expected;
};

/// The library's reasons in the words of this program's messages.
Words words_of(rapidjson::ParseErrorCode code) {
  using In = JsonMistake::In;
  switch (code) {
    case rapidjson::kParseErrorDocumentRootNotSingular:
      return {In::between, "expected nothing more after the end of the document"};
    case rapidjson::kParseErrorObjectMissName:
      return {In::between,
              "expected a key in double quotes or '}' (no comma may stand before a closing bracket)"};
    case rapidjson::kParseErrorObjectMissColon: return {In::between, "expected ':' after the key"};
    case rapidjson::kParseErrorObjectMissCommaOrCurlyBracket:
      return {In::between, "expected ',' or '}' after a value of an object"};
    case rapidjson::kParseErrorArrayMissCommaOrSquareBracket:
      return {In::between, "expected ',' or ']' after a value of a list"};
    case rapidjson::kParseErrorNumberMissFraction:
    case rapidjson::kParseErrorNumberMissExponent: return {In::number, {}};
    case rapidjson::kParseErrorStringMissQuotationMark: return {In::text, {}};
    case rapidjson::kParseErrorStringEscapeInvalid:
      return {In::escape, "unknown escape; a backslash itself is written '\\\\'"};
    case rapidjson::kParseErrorStringUnicodeEscapeInvalidHex:
      return {In::escape, "'\\u' needs four hexadecimal digits"};
    case rapidjson::kParseErrorStringUnicodeSurrogateInvalid:
      return {In::escape, "half of a surrogate pair; both halves must be written"};
    case rapidjson::kParseErrorUnspecificSyntaxError: return {In::comment, {}};
    default: return {In::value, "expected a value (no comma may stand before a closing bracket)"};
  }
}

/// Whether the text ends within a character that may be right so far.
bool is_cut_character(std::string_view rest) {
  const auto lead = static_cast<unsigned char>(rest.front());
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  return lead >= 0xC2 && lead <= 0xF4 && rest.size() < length &&
         std::all_of(rest.begin() + 1, rest.end(), continues);
}

constexpr std::string_view kNotUtf8 = "the text is not UTF-8 here";

/// In comments as well, which the library passes over. Returns where the text ends, or a character begins that its end cuts:
/// what that character stood in says more.
std::size_t require_utf8(const std::string& text, const NodeBuilder& builder) {
  JsonStream stream(text);
  Nowhere nowhere;
  while (stream.Tell() < text.size()) {
    const std::size_t begin = stream.Tell();
    if (rapidjson::UTF8<>::Validate(stream, nowhere)) continue;
    if (stream.Tell() == text.size() && is_cut_character(std::string_view(text).substr(begin))) return begin;
    builder.fail(begin, kNotUtf8);
  }
  return text.size();
}

template <unsigned flags>
void read(const std::string& text, std::size_t sound_end, NodeBuilder& builder) {
  JsonStream stream(text);
  Events events(stream, text, builder);
  rapidjson::Reader reader;
  // Iterative, so that no depth of nesting takes the stack.
  constexpr unsigned kFlags = flags | rapidjson::kParseIterativeFlag | rapidjson::kParseInsituFlag |
                              rapidjson::kParseNumbersAsStringsFlag;
  const rapidjson::ParseResult result = reader.Parse<kFlags>(stream, events);
  if (!result.IsError()) return;
  if (result.Code() == rapidjson::kParseErrorNumberTooBig)
    builder.fail(result.Offset(), "this number is too large");
  const Words words = words_of(result.Code());
  const bool in_text = words.in == JsonMistake::In::text || words.in == JsonMistake::In::escape;
  if (result.Offset() >= sound_end && sound_end < text.size() && !in_text && builder.still_open().empty())
    builder.fail(sound_end, kNotUtf8);
  explain({words.in, result.Offset(), words.expected, stream.string_begin(), events.end_of_last()}, text,
          builder);
}

}  // namespace

DocumentTree parse_json(std::string text, const std::string& file_name, const JsonRules& rules) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  DocumentTree tree;
  tree.source = std::make_shared<const DocumentSource>(std::move(text), file_name);
  const std::string& bytes = tree.source->text();
  if (bytes.size() > rules.max_bytes)
    throw tree.source->error(
        {}, format("the document has {} bytes, more than the {} allowed", bytes.size(), rules.max_bytes));
  NodeBuilder builder(*tree.source, rules);
  const std::size_t sound_end = require_utf8(bytes, builder);
  if (rules.comments)
    read<rapidjson::kParseCommentsFlag>(bytes, sound_end, builder);
  else
    read<rapidjson::kParseNoFlags>(bytes, sound_end, builder);
  if (sound_end < bytes.size()) builder.fail(sound_end, kNotUtf8);
  tree.root = builder.root();
  return tree;
}

}  // namespace ifov::io
