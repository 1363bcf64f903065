#include "io/mesh/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "core/error.h"
#include "core/names.h"

namespace ifov::io {
namespace {

constexpr std::pair<std::string_view, PlyType> kTypes[] = {
    {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64}};

constexpr std::size_t kLongestLine = 4096;
constexpr std::size_t kMostLines = 10000;

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  PlyHeader read() {
    find_line_end();
    if (!next_line() || word() != "ply") fail("expected 'ply', the first line of a PLY file");
    read_encoding();
    while (true) {
      if (!next_line()) fail("the file ends in its header; expected 'end_header'");
      const std::string_view key = word();
      if (key == "end_header") break;
      if (key == "element")
        read_element();
      else if (key == "property")
        read_property();
      else if (key == "comment")
        read_comment();
      else if (key != "obj_info" && !key.empty())
        fail(format("expected element, property, comment, obj_info or end_header, found '{}'", shown(key)));
    }
    header_.data_begin = at_;
    header_.lines = line_number_;
    check_sizes();
    return std::move(header_);
  }

 private:
  void find_line_end() {
    const std::size_t end = bytes_.substr(0, kLongestLine).find_first_of("\r\n");
    if (end == std::string_view::npos) return;
    line_end_ = bytes_.substr(end, 2) == "\r\n" ? "\r\n" : bytes_[end] == '\r' ? "\r" : "\n";
  }

  bool next_line() {
    if (at_ >= bytes_.size()) return false;
    ++line_number_;
    const std::size_t end = bytes_.substr(at_, kLongestLine).find(line_end_);
    if (end == std::string_view::npos && bytes_.size() - at_ > kLongestLine)
      fail(format("a line of the header is longer than {} bytes", kLongestLine));
    if (static_cast<std::size_t>(line_number_) > kMostLines)
      fail(format("the header has more than {} lines", kMostLines));
    line_ = bytes_.substr(at_, end);
    at_ = end == std::string_view::npos ? bytes_.size() : at_ + end + line_end_.size();
    in_line_ = 0;
    return true;
  }

  std::string_view word() {
    constexpr std::string_view kBlanks = " \t\r";
    word_begin_ = std::min(line_.find_first_not_of(kBlanks, in_line_), line_.size());
    in_line_ = std::min(line_.find_first_of(kBlanks, word_begin_), line_.size());
    return line_.substr(word_begin_, in_line_ - word_begin_);
  }

  static std::string shown(std::string_view word) {
    std::string text(word.substr(0, 40));
    for (char& c : text)
      if (c < ' ' || c > '~') c = '?';
    return text;
  }

  [[noreturn]] void fail(const std::string& message) const {
    const int column = static_cast<int>(word_begin_) + 1, line = std::max(line_number_, 1);
    throw InputError(format("{}:{}:{}: {}", name_, line, column, message), {name_, line, column});
  }

  void read_comment() {
    if (word() != "TextureFile") return;
    word();
    std::string_view name = line_.substr(word_begin_);
    while (name.ends_with(' ') || name.ends_with('\t') || name.ends_with('\r')) name.remove_suffix(1);
    if (!name.empty())
      header_.textures.push_back({std::string(name), line_number_, static_cast<int>(word_begin_) + 1});
  }

  void read_encoding() {
    do {
      if (!next_line()) fail("the file ends in its header; expected 'format'");
    } while (line_.starts_with("comment") || line_.starts_with("obj_info"));
    if (word() != "format") fail("expected 'format' after 'ply'");
    const std::string_view encoding = word();
    if (encoding == "ascii")
      header_.encoding = PlyEncoding::ascii;
    else if (encoding == "binary_little_endian")
      header_.encoding = PlyEncoding::little_endian;
    else if (encoding == "binary_big_endian")
      header_.encoding = PlyEncoding::big_endian;
    else
      fail(format("expected ascii, binary_little_endian or binary_big_endian, found '{}'", shown(encoding)));
    if (const std::string_view version = word(); version != "1.0")
      fail(format("expected version 1.0, found '{}'", shown(version)));
  }

  void read_element() {
    PlyElement element;
    element.name = std::string(word());
    if (element.name.empty()) fail("an element needs a name and a count");
    for (const PlyElement& other : header_.elements)
      if (other.name == element.name) fail(format("the element '{}' is there twice", shown(element.name)));
    const std::string_view count = word();
    const auto parsed = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (parsed.ec != std::errc{} || parsed.ptr != count.data() + count.size())
      fail(format("expected a count of rows, found '{}'", shown(count)));
    header_.elements.push_back(std::move(element));
  }

  PlyType type(bool of_count) {
    const std::string_view name = word();
    for (const auto& [spelling, value] : kTypes) {
      if (spelling != name) continue;
      if (of_count && (value == PlyType::float32 || value == PlyType::float64))
        fail("the count of a list needs an integer type");
      return value;
    }
    std::vector<std::string> names;
    for (const auto& entry : kTypes) names.emplace_back(entry.first);
    fail(format("expected a type ({}), found '{}'", list_names(names, "or"), shown(name)));
  }

  void read_property() {
    if (header_.elements.empty()) fail("a property must follow an element");
    PlyProperty property;
    const std::size_t before = in_line_;
    if (word() == "list")
      property.count_type = type(true);
    else
      in_line_ = before;
    property.type = type(false);
    property.name = std::string(word());
    if (property.name.empty()) fail("a property needs a name");
    PlyElement& element = header_.elements.back();
    if (element.find(property.name) != nullptr)
      fail(format("the element '{}' has the property '{}' twice", shown(element.name), shown(property.name)));
    element.properties.push_back(std::move(property));
  }

  /// The smallest size that the rows can have, against what is there.
  void check_sizes() const {
    const std::size_t available = bytes_.size() - header_.data_begin;
    std::uint64_t needed = 0;
    for (const PlyElement& element : header_.elements) {
      std::uint64_t row = 0;
      for (const PlyProperty& p : element.properties)
        row += header_.encoding == PlyEncoding::ascii ? 2 : size_of(p.count_type.value_or(p.type));
      if (row == 0) continue;
      // The last number of a text needs no blank after it.
      if (element.count > (available + 1 - std::min<std::uint64_t>(needed, available)) / row)
        throw InputError(
            format("{}: the header announces {} rows of '{}', which do not fit into the {} bytes "
                   "that follow it",
                   name_, element.count, shown(element.name), available),
            {name_, 0, 0});
      needed += element.count * row;
    }
  }

  std::string_view bytes_;
  const std::string& name_;
  PlyHeader header_;
  std::string_view line_end_ = "\n", line_;
  std::size_t at_ = 0, in_line_ = 0, word_begin_ = 0;
  int line_number_ = 0;
};

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

const PlyProperty* PlyElement::find(std::string_view property) const {
  for (const PlyProperty& p : properties)
    if (p.name == property) return &p;
  return nullptr;
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
  return HeaderReader(bytes, name).read();
}

}  // namespace ifov::io
