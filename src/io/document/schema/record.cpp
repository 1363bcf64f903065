#include "io/document/schema/record.h"

#include <algorithm>

#include "core/format.h"
#include "core/names.h"

namespace ifov::io {
namespace {

using Form = ValueDescription::Form;
using Type = DocumentNode::Type;

std::vector<std::string> keys_of(const ValueDescription& record, int group) {
  std::vector<std::string> keys;
  for (const FieldDescription& field : record.fields) {
    if (field.group == group) keys.push_back(field.key);
  }
  return keys;
}

void reject_unknown(const DocumentNode& node, const std::vector<std::string>& known) {
  for (const DocumentNode& member : node.members()) {
    if (std::find(known.begin(), known.end(), member.name()) != known.end()) continue;
    const std::string hint = did_you_mean(member.key(), known);
    member.fail_at_key(format("unknown key '{}' in {}{} Known keys: {}", member.key(), node.title(),
                              hint.empty() ? "." : hint, list_names(known, "and")));
  }
}

bool has_key(const DocumentNode& node, const std::string& key) {
  const auto& members = node.members();
  return std::any_of(members.begin(), members.end(), [&](const DocumentNode& m) { return m.name() == key; });
}

void take_former_names(const DocumentNode& node, const ValueDescription& record) {
  for (const FieldDescription& field : record.fields)
    for (const std::string& former : field.former) node.take_former_name(former, field.key);
}

void check_group(const DocumentNode& node, const std::vector<std::string>& keys, bool required) {
  const DocumentNode* first = nullptr;
  for (const DocumentNode& member : node.members()) {
    if (std::find(keys.begin(), keys.end(), member.name()) == keys.end()) continue;
    if (first != nullptr) {
      member.fail_at_key(format("'{}' cannot stand beside '{}': {} takes only one of {}", member.key(),
                                first->key(), node.title(), list_names(keys)));
    }
    first = &member;
  }
  if (required && first == nullptr) {
    node.fail(keys.size() == 1 ? format("{} lacks the key {}", node.title(), list_names(keys))
                               : format("{} needs exactly one of {}", node.title(), list_names(keys)));
  }
}

/// Fails unless the node is an object with known keys, all required ones, and of each group of keys that
/// exclude each other exactly (or at most) one. Keys under former names are found under their own from here on.
void check_members(const DocumentNode& node, const ValueDescription& record) {
  if (node.type() != Type::object) node.fail_expected(record.expected);
  take_former_names(node, record);
  std::vector<std::string> known;
  for (const FieldDescription& field : record.fields) known.push_back(field.key);
  reject_unknown(node, known);
  for (const FieldDescription& field : record.fields) {
    if (field.required && !has_key(node, field.key)) {
      node.fail(format("{} lacks the key '{}': {}", node.title(), field.key, field.value->expected));
    }
  }
  for (std::size_t i = 0; i < record.group_required.size(); ++i) {
    check_group(node, keys_of(record, static_cast<int>(i)), record.group_required[i]);
  }
  for (const auto& [key, other] : record.needs) {
    if (has_key(node, key) && !has_key(node, other)) {
      node.fail(format("'{}' needs the key '{}' beside it in {}", key, other, node.title()));
    }
  }
}

}  // namespace

RecordRows::RecordRows(std::string name, std::string doc) {
  description_.form = Form::record;
  description_.expected = "an object";
  description_.short_name = name;
  description_.name = std::move(name);
  description_.doc = std::move(doc);
}

std::shared_ptr<const RecordRows> RecordRows::shared() const {
  return std::make_shared<const RecordRows>(*this);
}

void RecordRows::add(FieldDescription field, Access access, Written unwritten) {
  description_.fields.push_back(std::move(field));
  rows_.push_back({std::move(access), std::move(unwritten)});
}

void RecordRows::add_former_name(std::string name) {
  description_.fields.back().former.push_back(std::move(name));
}

void RecordRows::add_need(std::string key, std::string other) {
  description_.needs.emplace_back(std::move(key), std::move(other));
}

void RecordRows::read(void* record, const DocumentNode& node) const {
  check_members(node, description_);
  for (const SetDefault& set_default : defaults_) set_default(record);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const DocumentNode* member = node.find(description_.fields[i].key);
    if (member == nullptr) continue;
    const Access& access = rows_[i].access;
    access.read(access.row.get(), record, *member);
  }
  for (const Check& check : checks_) check(record, node);
}

WrittenMember RecordRows::written_member(std::size_t row, const void* record, Writing& writing) const {
  const FieldDescription& field = description_.fields[row];
  const bool has_default = !field.default_json.empty();
  const Access& access = rows_[row].access;
  WrittenMember member = access.write(access.row.get(), record, !field.required && !has_default, writing);
  if (member.is_given)
    member.is_given =
        !member.value || member.value != rows_[row].unwritten || (has_default && writing.all_keys);
  return member;
}

Written RecordRows::written(const void* record, Writing& writing, std::span<const std::string> only) const {
  JsonValue::Members members;
  std::vector<bool> group_given(description_.group_required.size());
  for (std::size_t i = 0; i < description_.fields.size(); ++i) {
    const FieldDescription& field = description_.fields[i];
    const bool in_group = field.group >= 0;
    if (!only.empty() && std::find(only.begin(), only.end(), field.key) == only.end()) continue;
    if (in_group && group_given[static_cast<std::size_t>(field.group)]) continue;
    WrittenMember member = written_member(i, record, writing);
    if (!member.is_given && !field.required) continue;
    if (member.value) {
      members.emplace_back(field.key, std::move(*member.value));
      if (in_group) group_given[static_cast<std::size_t>(field.group)] = true;
      writing.fault.clear();
      continue;
    }
    if (!member.is_given) writing.fault.clear();
    writing.is_within(field.key);
    if (!in_group) return std::nullopt;
  }
  for (std::size_t g = 0; g < group_given.size(); ++g) {
    if (group_given[g] || !description_.group_required[g]) continue;
    if (writing.fault.empty()) writing.fault = list_names(keys_of(description_, static_cast<int>(g)));
    return std::nullopt;
  }
  return members;
}

int find_case(const DocumentNode& node, const ValueDescription& cases,
              const std::vector<std::vector<std::string>>& tags, int fallback) {
  if (node.type() != Type::object) node.fail_expected(cases.expected);
  for (const ValueDescriptionPtr& record : cases.alternatives) take_former_names(node, *record);
  int found = -1;
  std::string found_key;
  std::vector<std::string> all_tags, all_keys;
  for (const std::vector<std::string>& keys : tags) all_tags.insert(all_tags.end(), keys.begin(), keys.end());
  for (const DocumentNode& member : node.members()) {
    for (std::size_t i = 0; i < tags.size(); ++i) {
      if (std::find(tags[i].begin(), tags[i].end(), member.name()) == tags[i].end()) continue;
      if (found >= 0 && found != static_cast<int>(i)) {
        member.fail_at_key(
            format("'{}' cannot stand beside '{}' in {}", member.key(), found_key, node.title()));
      }
      found = static_cast<int>(i);
      found_key = member.key();
    }
  }
  if (found >= 0) return found;
  if (fallback >= 0) return fallback;
  for (const ValueDescriptionPtr& record : cases.alternatives) {
    for (const FieldDescription& field : record->fields) {
      if (std::find(all_keys.begin(), all_keys.end(), field.key) == all_keys.end())
        all_keys.push_back(field.key);
    }
  }
  reject_unknown(node, all_keys);
  node.fail(format("{} needs exactly one of {}", node.title(), list_names(all_tags)));
}

ValueDescriptionPtr cases_description(std::vector<ValueDescriptionPtr> cases) {
  ValueDescription d;
  d.form = Form::alternatives;
  for (const ValueDescriptionPtr& one : cases) {
    if (d.expected.find(one->expected) == std::string::npos) {
      d.expected += format("{}{}", d.expected.empty() ? "" : ", or ", one->expected);
    }
    d.short_name += format("{}{}", d.short_name.empty() ? "" : ", or ", one->short_name);
  }
  d.alternatives = std::move(cases);
  return std::make_shared<const ValueDescription>(std::move(d));
}

bool has_form(const DocumentNode& node, const ValueDescription& description) {
  switch (description.form) {
    case Form::boolean: return node.type() == Type::boolean;
    case Form::integer:
    case Form::number: return node.type() == Type::number;
    case Form::text: return node.type() == Type::text;
    case Form::list: return node.type() == Type::list;
    case Form::map:
    case Form::record: return node.type() == Type::object;
    case Form::alternatives:
      return std::any_of(description.alternatives.begin(), description.alternatives.end(),
                         [&](const ValueDescriptionPtr& one) { return has_form(node, *one); });
  }
  return false;
}

}  // namespace ifov::io
