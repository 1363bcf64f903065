#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ifov::io {

/// A value of JSON that is put together and compared before JsonWriter writes it.
class JsonValue {
 public:
  using List = std::vector<JsonValue>;
  using Members = std::vector<std::pair<std::string, JsonValue>>;
  using Any = std::variant<bool, std::int64_t, double, std::string, List, Members>;

  JsonValue(std::same_as<bool> auto value) : any_(value) {}
  JsonValue(double value) : any_(value) {}
  template <std::integral T>
  requires(!std::same_as<T, bool>) JsonValue(T value) : any_(static_cast<std::int64_t>(value)) {}
  JsonValue(std::string value) : any_(std::move(value)) {}
  JsonValue(std::string_view value) : any_(std::string(value)) {}
  JsonValue(const char* value) : any_(std::string(value)) {}
  JsonValue(List items) : any_(std::move(items)) {}
  JsonValue(Members members) : any_(std::move(members)) {}

  const Any& any() const { return any_; }
  bool holds_others() const { return any_.index() >= 4; }

  /// On one line, with a space behind commas and colons; nothing where that takes more than `most` bytes.
  std::optional<std::string> on_one_line(std::size_t most) const;

  friend bool operator==(const JsonValue& a, const JsonValue& b) { return a.any_ == b.any_; }

 private:
  Any any_;
};

}  // namespace ifov::io
