#include <algorithm>
#include <stdexcept>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/json_text.h"
#include "io/document/record_walk.h"

namespace ifov::io {
namespace {

using Form = ValueDescription::Form;

/// Names of definitions: "CSV spectrum of radiance" becomes "csv_spectrum_of_radiance".
std::string definition_name(std::string name) {
  for (char& c : name)
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c == ' ' || c == '-' ? '_' : c;
  return name;
}

std::string schema_of(const ValueDescription& value);

void add_bounds(JsonMembers& members, const ValueDescription& value) {
  if (value.minimum)
    members.emplace_back(value.above_minimum ? "exclusiveMinimum" : "minimum", json_number(*value.minimum));
  if (value.maximum)
    members.emplace_back(value.below_maximum ? "exclusiveMaximum" : "maximum", json_number(*value.maximum));
}

std::string schema_of_text(const ValueDescription& value) {
  JsonMembers members{{"type", json_string("string")}};
  if (!value.pattern.empty()) members.emplace_back("pattern", json_string(value.pattern));
  if (!value.choices.empty()) {
    std::vector<std::string> words;
    for (const std::string& word : value.choices) words.push_back(json_string(word));
    members.emplace_back("enum", json_list(words));
  }
  return json_object(members);
}

std::string schema_of_list(const ValueDescription& value) {
  return json_object({{"type", json_string("array")},
                      {"items", schema_of(*value.items)},
                      {"minItems", format("{}", value.min_count)},
                      {"maxItems", format("{}", value.max_count)}});
}

std::string schema_of_map(const ValueDescription& value) {
  const std::string pattern = value.pattern.empty() ? "^.+$" : value.pattern;
  return json_object({{"type", json_string("object")},
                      {"propertyNames", json_object({{"pattern", json_string(pattern)}})},
                      {"maxProperties", format("{}", value.max_count)},
                      {"additionalProperties", schema_of(*value.items)}});
}

std::string schema_of_alternatives(const ValueDescription& value) {
  std::vector<std::string> schemas;
  for (const ValueDescriptionPtr& one : value.alternatives) schemas.push_back(schema_of(*one));
  return json_object({{"anyOf", json_list(schemas)}});
}

std::string schema_of(const ValueDescription& value) {
  JsonMembers members;
  switch (value.form) {
    case Form::boolean:
      return json_object({{"type", json_string("boolean")}});
    case Form::integer:
    case Form::number:
      members.emplace_back("type", json_string(value.form == Form::integer ? "integer" : "number"));
      add_bounds(members, value);
      return json_object(members);
    case Form::text:
      return schema_of_text(value);
    case Form::list:
      return schema_of_list(value);
    case Form::map:
      return schema_of_map(value);
    case Form::record:
      return json_object({{"$ref", json_string("#/definitions/" + definition_name(value.name))}});
    case Form::alternatives:
      return schema_of_alternatives(value);
  }
  throw std::logic_error("unknown form of value");
}

std::string required_keys(const std::vector<std::string>& keys) {
  std::vector<std::string> quoted;
  for (const std::string& key : keys) quoted.push_back(json_string(key));
  return json_list(quoted);
}

/// Exactly one of the keys of a group, or at most one.
std::string schema_of_group(const ValueDescription& record, int group, bool required) {
  std::vector<std::string> cases;
  for (const FieldDescription& field : record.fields) {
    if (field.group == group) cases.push_back(json_object({{"required", required_keys({field.key})}}));
  }
  if (!required) cases.push_back(json_object({{"not", json_object({{"anyOf", json_list(cases)}})}}));
  return json_object({{"oneOf", json_list(cases)}});
}

std::string schema_of_field(const FieldDescription& field) {
  const std::string description = json_string(format("{} ({})", field.doc, field.value->short_name));
  const std::string value = schema_of(*field.value);
  JsonMembers members{{"description", description}};
  if (!field.default_json.empty()) members.emplace_back("default", field.default_json);
  // Draft 7 ignores what stands beside a $ref.
  if (field.value->form == Form::record) {
    members.emplace_back("allOf", json_list({value}));
    return json_object(members);
  }
  std::string merged = json_object(members);
  merged.pop_back();
  return merged + "," + value.substr(1);
}

std::string definition_of(const ValueDescription& record) {
  JsonMembers properties, dependencies,
      members{{"type", json_string("object")}, {"description", json_string(record.doc)}};
  std::vector<std::string> required, groups;
  for (const FieldDescription& field : record.fields) {
    properties.emplace_back(field.key, schema_of_field(field));
    if (field.required) required.push_back(field.key);
  }
  for (std::size_t i = 0; i < record.group_required.size(); ++i) {
    groups.push_back(schema_of_group(record, static_cast<int>(i), record.group_required[i]));
  }
  for (const auto& [key, other] : record.needs) dependencies.emplace_back(key, required_keys({other}));
  members.emplace_back("properties", json_object(properties));
  members.emplace_back("additionalProperties", "false");
  if (!required.empty()) members.emplace_back("required", required_keys(required));
  if (!groups.empty()) members.emplace_back("allOf", json_list(groups));
  if (!dependencies.empty()) members.emplace_back("dependencies", json_object(dependencies));
  return json_object(members);
}

}  // namespace

std::string schema_json() {
  const ValueDescription& document = document_description();
  JsonMembers definitions;
  for (const ValueDescription* record : records_within(document)) {
    definitions.emplace_back(definition_name(record->name), definition_of(*record));
  }
  // What a document that includes others may leave out, only the program can say.
  const std::string including = json_object({{"type", json_string("object")}, {"required", required_keys({"include"})}});
  return json_indented(json_object({{"$schema", json_string("http://json-schema.org/draft-07/schema#")},
                                    {"title", json_string("ifov document")},
                                    {"if", including},
                                    {"else", json_object({{"allOf", json_list({schema_of(document)})}})},
                                    {"definitions", json_object(definitions)}}));
}

}  // namespace ifov::io
