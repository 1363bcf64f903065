#include "io/mesh/ply_values.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/error.h"

namespace ifov::io {
namespace {

template <class T>
double decoded(const char* bytes, bool swap) {
  char raw[sizeof(T)];
  std::memcpy(raw, bytes, sizeof(T));
  if (swap) std::reverse(raw, raw + sizeof(T));
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return static_cast<double>(value);
}

double decoded(PlyType type, const char* bytes, bool swap) {
  switch (type) {
    case PlyType::int8: return decoded<std::int8_t>(bytes, swap);
    case PlyType::uint8: return decoded<std::uint8_t>(bytes, swap);
    case PlyType::int16: return decoded<std::int16_t>(bytes, swap);
    case PlyType::uint16: return decoded<std::uint16_t>(bytes, swap);
    case PlyType::int32: return decoded<std::int32_t>(bytes, swap);
    case PlyType::uint32: return decoded<std::uint32_t>(bytes, swap);
    case PlyType::float32: return decoded<float>(bytes, swap);
    case PlyType::float64: break;
  }
  return decoded<double>(bytes, swap);
}

static_assert(std::endian::native == std::endian::little);

}  // namespace

PlyValues::PlyValues(std::string_view bytes, const PlyHeader& header, std::string name)
    : bytes_(bytes),
      encoding_(header.encoding),
      name_(std::move(name)),
      at_(header.data_begin),
      value_begin_(header.data_begin),
      line_begin_(header.data_begin),
      line_(header.lines + 1) {}

void PlyValues::fail(const std::string& message) const {
  if (encoding_ != PlyEncoding::ascii)
    throw InputError(format("{}: byte {}: {}", name_, value_begin_, message), {name_, 0, 0});
  const int column = static_cast<int>(value_begin_ - line_begin_) + 1;
  throw InputError(format("{}:{}:{}: {}", name_, line_, column, message), {name_, line_, column});
}

std::string_view PlyValues::text_word() {
  const auto is_blank = [](char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
  };
  for (; at_ < bytes_.size() && is_blank(bytes_[at_]); ++at_) {
    const bool pair = bytes_[at_] == '\r' && at_ + 1 < bytes_.size() && bytes_[at_ + 1] == '\n';
    if (bytes_[at_] == '\n' || (bytes_[at_] == '\r' && !pair)) {
      ++line_;
      line_begin_ = at_ + 1;
    }
  }
  value_begin_ = at_;
  while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
  return bytes_.substr(value_begin_, at_ - value_begin_);
}

double PlyValues::number(PlyType type) {
  if (encoding_ != PlyEncoding::ascii) {
    value_begin_ = at_;
    const std::size_t size = size_of(type);
    if (bytes_.size() - at_ < size) fail("the file ends before all announced rows are read");
    at_ += size;
    return decoded(type, bytes_.data() + value_begin_, encoding_ == PlyEncoding::big_endian);
  }
  std::string_view word = text_word();
  if (word.empty()) fail("the file ends before all announced rows are read");
  const std::string_view found = word;
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) {
    std::string shown(found.substr(0, 40));
    for (char& c : shown)
      if (c < ' ' || c > '~') c = '?';
    fail(format("expected a number, found '{}'", shown));
  }
  return value;
}

double PlyValues::finite_number(PlyType type, const char* what) {
  const double value = number(type);
  if (!std::isfinite(value)) fail(format("expected a finite number for {}, found {}", what, value));
  return value;
}

std::uint64_t PlyValues::list_count(PlyType count_type, PlyType item_type) {
  const double count = number(count_type);
  const std::size_t left = bytes_.size() - at_;
  const std::size_t most = encoding_ == PlyEncoding::ascii ? left / 2 + 1 : left / size_of(item_type);
  if (!(count >= 0.0) || count != std::floor(count))
    fail(format("expected the count of a list, found {}", count));
  if (count > static_cast<double>(most))
    fail(format("a list announces {} items, which do not fit into the {} bytes left", count, left));
  return static_cast<std::uint64_t>(count);
}

void PlyValues::skip(const PlyProperty& property) {
  const std::uint64_t count = property.count_type ? list_count(*property.count_type, property.type) : 1;
  for (std::uint64_t k = 0; k < count; ++k) number(property.type);
}

}  // namespace ifov::io
