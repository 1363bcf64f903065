#include "io/json/json_value.h"

#include "io/json/json_writer.h"

namespace ifov::io {
namespace {

/// Adds the value to `text`, as far as it stays within `most` bytes; whether it does.
bool add(const JsonValue& value, std::size_t most, std::string& text);

bool add_all(const JsonValue::List& items, std::size_t most, std::string& text) {
  text += '[';
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k > 0) text += ", ";
    if (!add(items[k], most, text)) return false;
  }
  text += ']';
  return text.size() <= most;
}

bool add_all(const JsonValue::Members& members, std::size_t most, std::string& text) {
  text += '{';
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (k > 0) text += ", ";
    text += json_string(members[k].first) + ": ";
    if (!add(members[k].second, most, text)) return false;
  }
  text += '}';
  return text.size() <= most;
}

bool add(const JsonValue& value, std::size_t most, std::string& text) {
  if (const auto* items = std::get_if<JsonValue::List>(&value.any())) return add_all(*items, most, text);
  if (const auto* members = std::get_if<JsonValue::Members>(&value.any()))
    return add_all(*members, most, text);
  JsonWriter writer(JsonWriter::Layout::compact);
  writer.value(value);
  text += writer.written();
  return text.size() <= most;
}

}  // namespace

std::optional<std::string> JsonValue::on_one_line(std::size_t most) const {
  std::string text;
  return add(*this, most, text) ? std::optional(text) : std::nullopt;
}

}  // namespace ifov::io
