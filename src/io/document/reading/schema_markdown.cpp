#include <vector>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/reading/record_walk.h"

namespace ifov::io {
namespace {

using Form = ValueDescription::Form;

constexpr const char* kIntroduction = R"(# The document

<!-- Written by `ifov schema --markdown` from the tables that the reader uses; do not edit by hand. -->

A document is JSON (UTF-8) that may hold comments (`// ...` and `/* ... */`). It describes a scene, its light, the
sensor that looks at it and how accurate the result is to be. `ifov check FILE` reads it and says what is wrong;
`ifov schema` prints a JSON Schema (draft 7) with which editors complete and check while you type.

- Values with units are texts: `"1 m"`, `"40 degC"`, `"550 nm"`, `"12 W m-2 sr-1 um-1"`. A number without a unit, where
  one is needed, is an error.
- Coordinates are metres east, north and up: `["0 m", "10 m", "1.5 m"]`. Directions are plain numbers: `[0, 0, 1]`.
- Files are looked for relative to the document.
- Unknown keys, keys given twice and values out of range are errors, which name file, line and column.
- Keys marked *one of* exclude each other: exactly one of them is given.
- Keys that were *formerly* called otherwise are read under that name in this version, with a warning.

)";

std::string anchor(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (c == ' ' || c == '-')
      text += '-';
    else if (c >= 'A' && c <= 'Z')
      text += static_cast<char>(c - 'A' + 'a');
    else
      text += c;
  }
  return text;
}

std::string value_text(const ValueDescription& value) {
  switch (value.form) {
    case Form::record: return format("[{}](#{})", value.name, anchor(value.name));
    case Form::list: {
      const std::string count = value.min_count == value.max_count
                                    ? format("{}", value.min_count)
                                    : format("{} to {}", value.min_count, value.max_count);
      return format("list of {}: {}", count, value_text(*value.items));
    }
    case Form::map: return format("{}: {}", value.short_name, value_text(*value.items));
    case Form::alternatives: {
      std::string text;
      for (const ValueDescriptionPtr& one : value.alternatives) {
        text += format("{}{}", text.empty() ? "" : ", or ", value_text(*one));
      }
      return text;
    }
    case Form::text: {
      if (value.choices.empty()) return value.short_name;
      std::string words;
      for (const std::string& word : value.choices)
        words += format("{}`\"{}\"`", words.empty() ? "" : ", ", word);
      return words;
    }
    case Form::boolean:
    case Form::integer:
    case Form::number: break;
  }
  return value.short_name;
}

std::string presence(const ValueDescription& record, const FieldDescription& field) {
  if (field.group >= 0) {
    return record.group_required[static_cast<std::size_t>(field.group)] ? "*one of*" : "*at most one of*";
  }
  if (field.required) return "**required**";
  return field.default_json.empty() ? "" : format("`{}`", field.default_json);
}

/// " Formerly `a`.", or nothing.
std::string former_names(const FieldDescription& field) {
  std::string text;
  for (const std::string& name : field.former) text += format("{}`{}`", text.empty() ? "" : ", ", name);
  return text.empty() ? "" : format(" (formerly {})", text);
}

std::string table_of(const ValueDescription& record) {
  std::string text = format("## {}\n\n{}\n\n", record.name, record.doc);
  if (record.fields.empty()) return text + "An empty object: `{}`.\n\n";
  text += "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const FieldDescription& field : record.fields) {
    text += format("| `{}` | {} | {} | {}{} |\n", field.key, value_text(*field.value),
                   presence(record, field), field.doc, former_names(field));
  }
  return text + "\n";
}

}  // namespace

std::string schema_markdown() {
  std::string text = kIntroduction;
  for (const ValueDescription* record : records_within(document_description())) text += table_of(*record);
  text.pop_back();
  return text;
}

}  // namespace ifov::io
