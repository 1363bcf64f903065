#include "io/document/reading/record_walk.h"

#include <algorithm>

#include "io/document/document.h"
#include "io/document/reading/document_kind.h"

namespace ifov::io {
namespace {

void visit(const ValueDescription& value, std::vector<const ValueDescription*>& records) {
  if (value.form == ValueDescription::Form::record) {
    const bool seen = std::any_of(records.begin(), records.end(),
                                  [&](const ValueDescription* record) { return record->name == value.name; });
    if (seen) return;
    records.push_back(&value);
  }
  for (const FieldDescription& field : value.fields) visit(*field.value, records);
  for (const ValueDescriptionPtr& one : value.alternatives) visit(*one, records);
  if (value.items) visit(*value.items, records);
}

}  // namespace

const ValueDescription& document_description() { return *whole_document_type().description; }

std::vector<const ValueDescription*> records_within(const ValueDescription& root) {
  std::vector<const ValueDescription*> records;
  visit(root, records);
  return records;
}

}  // namespace ifov::io
