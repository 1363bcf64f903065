#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>

#include "io/json/json_value.h"
#include "io/json/node.h"

namespace ifov::io {

/// Writes JSON in the order in which it is told. A number is the shortest text that reads back as the same; one that is not
/// finite is null.
class JsonWriter {
 public:
  /// Without white space; or two spaces a level, lists of plain values and what else is short on one line, and a line end.
  enum class Layout { compact, indented };

  explicit JsonWriter(Layout layout);
  ~JsonWriter();

  /// A text, a number, true or false, or a range of such.
  template <class T>
  void value(const T& value) {
    if constexpr (std::convertible_to<T, std::string_view>) {
      text(value);
    } else if constexpr (std::ranges::range<T>) {
      begin_list(true);
      for (const auto& item : value) this->value(item);
      end_list();
    } else if constexpr (std::same_as<T, bool>) {
      boolean(value);
    } else if constexpr (std::floating_point<T>) {
      number(value);
    } else if constexpr (std::signed_integral<T>) {
      integer(value);
    } else {
      static_assert(std::unsigned_integral<T>);
      natural(value);
    }
  }
  void value(const JsonValue& value);
  void null();

  /// `content` writes the members.
  void object(std::invocable auto&& content) {
    begin_object();
    content();
    end_object();
  }
  /// `content` writes the items, each of which gets a line.
  void list(std::invocable auto&& content) {
    begin_list(false);
    content();
    end_list();
  }

  void key(std::string_view name);
  void member(std::string_view name, const auto& value) {
    key(name);
    this->value(value);
  }
  void object(std::string_view name, std::invocable auto&& content) {
    key(name);
    object(content);
  }
  void list(std::string_view name, std::invocable auto&& content) {
    key(name);
    list(content);
  }

  /// A value that was read; `text_of` may say another text than the node's.
  using TextOf = std::function<std::string(const DocumentNode&)>;
  void node(const DocumentNode& node, const TextOf& text_of = &DocumentNode::text);

  std::string written() const;

 private:
  struct Writers;

  void begin_object();
  void end_object();
  void begin_list(bool is_plain);
  void end_list();
  void text(std::string_view value);
  void number(double value);
  void number(float value);
  void integer(std::int64_t value);
  void natural(std::uint64_t value);
  void boolean(bool value);
  void list(const JsonValue::List& items);
  void members(const JsonValue::Members& members);

  std::unique_ptr<Writers> writers_;
};

/// In quotes, escaped.
std::string json_string(std::string_view text);

}  // namespace ifov::io
