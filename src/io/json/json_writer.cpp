#include "io/json/json_writer.h"

#include <rapidjson/prettywriter.h>
#include <rapidjson/stringbuffer.h>

#include <algorithm>
#include <cmath>

#include "core/format.h"

namespace ifov::io {

struct JsonWriter::Writers {
  using Compact = rapidjson::Writer<rapidjson::StringBuffer>;
  using Indented = rapidjson::PrettyWriter<rapidjson::StringBuffer>;

  explicit Writers(Layout layout) : is_indented(layout == Layout::indented) { indented.SetIndent(' ', 2); }

  /// The two of the library share their names alone.
  void with(auto&& call) {
    if (is_indented)
      call(indented);
    else
      call(compact);
  }

  void number(const std::string& digits) {
    with([&](auto& writer) { writer.RawValue(digits.data(), digits.size(), rapidjson::kNumberType); });
  }

  rapidjson::StringBuffer buffer;
  Compact compact{buffer};
  Indented indented{buffer};
  bool is_indented;
};

namespace {

/// Of what stands on one line though it holds other values, without what stands before it.
constexpr std::size_t kLongestLine = 100;

unsigned size_of(std::string_view text) { return static_cast<unsigned>(text.size()); }

/// The library's own digits are not always the fewest.
template <class Number>
std::string digits_of(Number value) {
  if (!std::isfinite(value)) return "null";
  return value == Number{0} && std::signbit(value) ? "-0.0" : format("{}", value);
}

}  // namespace

JsonWriter::JsonWriter(Layout layout) : writers_(std::make_unique<Writers>(layout)) {}
JsonWriter::~JsonWriter() = default;

void JsonWriter::null() {
  writers_->with([](auto& writer) { writer.Null(); });
}

void JsonWriter::key(std::string_view name) {
  writers_->with([&](auto& writer) { writer.Key(name.data(), size_of(name)); });
}

void JsonWriter::begin_object() {
  writers_->with([](auto& writer) { writer.StartObject(); });
}

void JsonWriter::end_object() {
  writers_->with([](auto& writer) { writer.EndObject(); });
}

void JsonWriter::begin_list(bool is_plain) {
  writers_->with([](auto& writer) { writer.StartArray(); });
  if (is_plain) writers_->indented.SetFormatOptions(rapidjson::kFormatSingleLineArray);
}

void JsonWriter::end_list() {
  writers_->with([](auto& writer) { writer.EndArray(); });
  writers_->indented.SetFormatOptions(rapidjson::kFormatDefault);
}

void JsonWriter::text(std::string_view value) {
  writers_->with([&](auto& writer) { writer.String(value.data(), size_of(value)); });
}

void JsonWriter::number(double value) { writers_->number(digits_of(value)); }
void JsonWriter::number(float value) { writers_->number(digits_of(value)); }

void JsonWriter::integer(std::int64_t value) {
  writers_->with([&](auto& writer) { writer.Int64(value); });
}

void JsonWriter::natural(std::uint64_t value) {
  writers_->with([&](auto& writer) { writer.Uint64(value); });
}

void JsonWriter::boolean(bool value) {
  writers_->with([&](auto& writer) { writer.Bool(value); });
}

void JsonWriter::list(const JsonValue::List& items) {
  begin_list(
      std::none_of(items.begin(), items.end(), [](const JsonValue& item) { return item.holds_others(); }));
  for (const JsonValue& item : items) value(item);
  end_list();
}

void JsonWriter::members(const JsonValue::Members& members) {
  begin_object();
  for (const auto& [name, value] : members) member(name, value);
  end_object();
}

void JsonWriter::value(const JsonValue& value) {
  if (writers_->is_indented && value.holds_others()) {
    const auto line = value.on_one_line(kLongestLine);
    if (line)
      return static_cast<void>(
          writers_->indented.RawValue(line->data(), line->size(), rapidjson::kObjectType));
  }
  std::visit(
      [&](const auto& any) {
        using Any = std::decay_t<decltype(any)>;
        if constexpr (std::same_as<Any, JsonValue::List>)
          list(any);
        else if constexpr (std::same_as<Any, JsonValue::Members>)
          members(any);
        else
          this->value(any);
      },
      value.any());
}

void JsonWriter::node(const DocumentNode& node, const TextOf& text_of) {
  using Type = DocumentNode::Type;
  const auto holds = [](const DocumentNode& item) {
    return item.type() == Type::list || item.type() == Type::object;
  };
  switch (node.type()) {
    case Type::null: return null();
    case Type::boolean: return boolean(node.boolean());
    case Type::number: return node.is_integer() ? integer(node.integer()) : number(node.number());
    case Type::text: return text(text_of(node));
    case Type::list:
      begin_list(std::none_of(node.items().begin(), node.items().end(), holds));
      for (const DocumentNode& item : node.items()) this->node(item, text_of);
      return end_list();
    case Type::object:
      begin_object();
      for (const DocumentNode& member : node.members()) {
        key(member.key());
        this->node(member, text_of);
      }
      return end_object();
  }
}

std::string JsonWriter::written() const {
  const std::string text(writers_->buffer.GetString(), writers_->buffer.GetSize());
  return writers_->is_indented ? text + '\n' : text;
}

std::string json_string(std::string_view text) {
  JsonWriter writer(JsonWriter::Layout::compact);
  writer.value(text);
  return writer.written();
}

}  // namespace ifov::io
