#include <algorithm>
#include <stdexcept>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/reading/record_walk.h"
#include "io/json/json_adapter.h"
#include "io/json/json_writer.h"

namespace ifov::io {
namespace {

using Form = ValueDescription::Form;

/// Names of definitions: "CSV spectrum of radiance" becomes "csv_spectrum_of_radiance".
std::string definition_name(std::string name) {
  for (char& c : name)
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c == ' ' || c == '-' ? '_' : c;
  return name;
}

/// The members of a schema, each time of the object that is being written.
void write_schema(JsonWriter& json, const ValueDescription& value);

void write_bounds(JsonWriter& json, const ValueDescription& value) {
  if (value.minimum) json.member(value.above_minimum ? "exclusiveMinimum" : "minimum", *value.minimum);
  if (value.maximum) json.member(value.below_maximum ? "exclusiveMaximum" : "maximum", *value.maximum);
}

void write_map(JsonWriter& json, const ValueDescription& value) {
  const std::string pattern = value.pattern.empty() ? "^.+$" : value.pattern;
  json.member("type", "object");
  json.object("propertyNames", [&] { json.member("pattern", pattern); });
  json.member("maxProperties", value.max_count);
  json.object("additionalProperties", [&] { write_schema(json, *value.items); });
}

void write_schema(JsonWriter& json, const ValueDescription& value) {
  switch (value.form) {
    case Form::boolean: return json.member("type", "boolean");
    case Form::integer:
    case Form::number:
      json.member("type", value.form == Form::integer ? "integer" : "number");
      return write_bounds(json, value);
    case Form::text:
      json.member("type", "string");
      if (!value.pattern.empty()) json.member("pattern", value.pattern);
      if (!value.choices.empty()) json.member("enum", value.choices);
      return;
    case Form::list:
      json.member("type", "array");
      json.object("items", [&] { write_schema(json, *value.items); });
      json.member("minItems", value.min_count);
      return json.member("maxItems", value.max_count);
    case Form::map: return write_map(json, value);
    case Form::record: return json.member("$ref", "#/definitions/" + definition_name(value.name));
    case Form::alternatives:
      return json.list("anyOf", [&] {
        for (const ValueDescriptionPtr& one : value.alternatives)
          json.object([&] { write_schema(json, *one); });
      });
  }
  throw std::logic_error("unknown form of value");
}

void write_required(JsonWriter& json, const std::vector<std::string>& keys) { json.member("required", keys); }

/// The key of a field and its former names.
std::vector<std::string> names_of(const FieldDescription& field) {
  std::vector<std::string> names{field.key};
  names.insert(names.end(), field.former.begin(), field.former.end());
  return names;
}

/// Exactly one of the keys of a group, or at most one.
void write_group(JsonWriter& json, const ValueDescription& record, int group, bool required) {
  const auto write_cases = [&] {
    for (const FieldDescription& field : record.fields)
      if (field.group == group)
        for (const std::string& name : names_of(field)) json.object([&] { write_required(json, {name}); });
  };
  json.list("oneOf", [&] {
    write_cases();
    if (!required) json.object([&] { json.object("not", [&] { json.list("anyOf", write_cases); }); });
  });
}

void write_field(JsonWriter& json, const FieldDescription& field) {
  json.member("description", format("{} ({})", field.doc, field.value->short_name));
  if (!field.default_json.empty()) {
    json.key("default");
    json.node(*parse_json(field.default_json, "default of " + field.key).root);
  }
  // Draft 7 ignores what stands beside a $ref.
  if (field.value->form == Form::record)
    json.list("allOf", [&] { json.object([&] { write_schema(json, *field.value); }); });
  else
    write_schema(json, *field.value);
}

void write_former_field(JsonWriter& json, const FieldDescription& field) {
  json.member("description", format("former name of '{}'", field.key));
  json.member("deprecated", true);
  json.list("allOf", [&] { json.object([&] { write_schema(json, *field.value); }); });
}

/// A key and its former names are not given together, and one of them where the key is required.
void write_names(JsonWriter& json, const FieldDescription& field) {
  const auto write_cases = [&] {
    for (const std::string& name : names_of(field)) json.object([&] { write_required(json, {name}); });
  };
  json.list("oneOf", [&] {
    write_cases();
    if (!field.required) json.object([&] { json.object("not", [&] { json.list("anyOf", write_cases); }); });
  });
}

void write_definition(JsonWriter& json, const ValueDescription& record) {
  json.member("type", "object");
  json.member("description", record.doc);
  json.object("properties", [&] {
    for (const FieldDescription& field : record.fields) {
      json.object(field.key, [&] { write_field(json, field); });
      for (const std::string& former : field.former)
        json.object(former, [&] { write_former_field(json, field); });
    }
  });
  json.member("additionalProperties", false);
  std::vector<std::string> required;
  for (const FieldDescription& field : record.fields)
    if (field.required && field.former.empty()) required.push_back(field.key);
  if (!required.empty()) write_required(json, required);
  const auto is_renamed = [](const FieldDescription& field) {
    return !field.former.empty() && field.group < 0;
  };
  if (!record.group_required.empty() || std::any_of(record.fields.begin(), record.fields.end(), is_renamed))
    json.list("allOf", [&] {
      for (std::size_t i = 0; i < record.group_required.size(); ++i)
        json.object([&] { write_group(json, record, static_cast<int>(i), record.group_required[i]); });
      for (const FieldDescription& field : record.fields)
        if (is_renamed(field)) json.object([&] { write_names(json, field); });
    });
  if (!record.needs.empty())
    json.object("dependencies", [&] {
      for (const auto& [key, other] : record.needs) json.member(key, std::vector<std::string>{other});
    });
}

}  // namespace

std::string schema_json() {
  const ValueDescription& document = document_description();
  JsonWriter json(JsonWriter::Layout::indented);
  json.object([&] {
    json.member("$schema", "http://json-schema.org/draft-07/schema#");
    json.member("title", "ifov document");
    // What a document that includes others, or has several sensors, may leave out, only the program can say.
    json.object("if", [&] {
      json.list("anyOf", [&] {
        for (const char* key : {"include", "instruments"})
          json.object([&] {
            json.member("type", "object");
            write_required(json, {key});
          });
      });
    });
    json.object("else",
                [&] { json.list("allOf", [&] { json.object([&] { write_schema(json, document); }); }); });
    json.object("definitions", [&] {
      for (const ValueDescription* record : records_within(document))
        json.object(definition_name(record->name), [&] { write_definition(json, *record); });
    });
  });
  return json.written();
}

}  // namespace ifov::io
