#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/document/schema/schema_type.h"
#include "io/document/schema/target.h"
#include "io/json/json_adapter.h"

namespace ifov::io {

/// Fails unless the node is an object with known keys, all required ones, and of each group of keys that
/// exclude each other exactly (or at most) one. Keys under former names are found under their own from here on.
void check_members(const DocumentNode& node, const ValueDescription& record);

/// Index of the one case whose tags the node has; `fallback` where it has none (-1: an error that lists the
/// tags).
int find_case(const DocumentNode& node, const ValueDescription& cases,
              const std::vector<std::vector<std::string>>& tags, int fallback);

ValueDescriptionPtr cases_description(std::vector<ValueDescriptionPtr> cases);

/// Whether a row writes its key, and what: a value of null could not be written.
struct WrittenMember {
  bool is_given = false;
  Written value = std::nullopt;
};

/// The members of an object from its rows, each `write(i)`. Nothing where one cannot be written or a required one is not
/// given; of keys that exclude each other the first that can be is written. `only` some keys, or all where it is empty.
Written written_members(const ValueDescription& record, Writing& writing, std::span<const std::string> only,
                        const std::function<WrittenMember(std::size_t)>& write);

/// The table of an object's keys: written once, it reads a T, writes it, and describes it for schema and reference.
template <class T>
class Record {
 public:
  Record(std::string name, std::string doc) {
    description_.form = ValueDescription::Form::record;
    description_.expected = "an object";
    description_.short_name = name;
    description_.name = std::move(name);
    description_.doc = std::move(doc);
  }

  /// Where a value goes and comes from is said by its target (target.h).
  template <class V, class Target>
  Record& required(std::string key, Target target, const SchemaType<V>& type, std::string doc) {
    return add({std::move(key), std::move(doc), type.description, true, {}, -1}, target, type);
  }

  template <class V, class Target>
  Record& optional(std::string key, Target target, const SchemaType<V>& type, std::string doc) {
    set_unwritten<V>(target, type);
    return add({std::move(key), std::move(doc), type.description, false, {}, -1}, target, type);
  }

  /// Without the key, the value is what this JSON text would have given.
  template <class V, class Target>
  Record& with_default(std::string key, Target target, const SchemaType<V>& type, std::string json,
                       std::string doc) {
    const DocumentTree tree = parse_json(json, "default of " + key);
    const V value = type.read(*tree.root);
    defaults_.push_back([target, value](T& record) { store(record, target, value); });
    Writing writing;
    unwritten_ = type.write(value, writing);
    return add({std::move(key), std::move(doc), type.description, false, std::move(json), -1}, target, type);
  }

  /// The cases that follow exclude each other: exactly one of them is given (at most one).
  Record& exactly_one() { return group(true); }
  Record& at_most_one() { return group(false); }

  template <class V, class Target>
  Record& one(std::string key, Target target, const SchemaType<V>& type, std::string doc) {
    const int group = static_cast<int>(description_.group_required.size()) - 1;
    if (!description_.group_required.back()) set_unwritten<V>(target, type);
    return add({std::move(key), std::move(doc), type.description, false, {}, group}, target, type);
  }

  /// The key above was called `name` and is still read under it (docs/developer/versions.md says how long).
  Record& formerly(std::string name) {
    description_.fields.back().former.push_back(std::move(name));
    return *this;
  }

  /// `key` is given only beside `other`.
  Record& needs(std::string key, std::string other) {
    description_.needs.emplace_back(std::move(key), std::move(other));
    return *this;
  }

  /// Called after all keys are read: (const T&, const DocumentNode&).
  Record& check(std::function<void(const T&, const DocumentNode&)> condition) {
    checks_.push_back(std::move(condition));
    return *this;
  }

  SchemaType<T> type() const {
    auto description = std::make_shared<const ValueDescription>(description_);
    return {
        description,
        [description, readers = readers_, defaults = defaults_, checks = checks_](const DocumentNode& node) {
          check_members(node, *description);
          T record{};
          if constexpr (requires { record.position = node.position(); }) record.position = node.position();
          for (const auto& set_default : defaults) set_default(record);
          for (std::size_t i = 0; i < readers.size(); ++i) {
            const DocumentNode* member = node.find(description->fields[i].key);
            if (member != nullptr) readers[i](record, *member);
          }
          for (const auto& condition : checks) condition(record, node);
          return record;
        },
        [description, writers = writers_](const T& record, Writing& writing) {
          return written_members(*description, writing, {},
                                 [&](std::size_t i) { return writers[i](record, writing); });
        }};
  }

  /// The members of some keys alone; of all where there are none.
  Written written(const T& record, Writing& writing, std::span<const std::string> only) const {
    return written_members(description_, writing, only,
                           [&](std::size_t i) { return writers_[i](record, writing); });
  }

 private:
  /// Without its key, a row says what a T has anyway: what that is needs no writing.
  template <class V, class Target>
  void set_unwritten(const Target& target, const SchemaType<V>& type) {
    const std::optional<V> value = load<V>(T{}, target);
    Writing writing;
    if (value) unwritten_ = type.write(*value, writing);
  }

  template <class V>
  static bool is_nothing(const V& value) {
    if constexpr (requires {
                    { value.empty() } -> std::same_as<bool>;
                  })
      return value.empty();
    return false;
  }

  template <class Target, class V>
  Record& add(FieldDescription field, Target target, const SchemaType<V>& type) {
    const bool has_default = !field.default_json.empty(), is_required = field.required;
    description_.fields.push_back(std::move(field));
    readers_.push_back([target, read = type.read](T& record, const DocumentNode& node) {
      store(record, target, read(node));
    });
    writers_.push_back(
        [target, write = type.write, has_default, is_required,
         unwritten = std::exchange(unwritten_, std::nullopt)](const T& record, Writing& writing) {
          const std::optional<V> value = load<V>(record, target);
          if (!value || (!is_required && !has_default && is_nothing(*value))) return WrittenMember{};
          WrittenMember member{true, write(*value, writing)};
          member.is_given = !member.value || member.value != unwritten || (has_default && writing.all_keys);
          return member;
        });
    return *this;
  }

  Record& group(bool required) {
    description_.group_required.push_back(required);
    return *this;
  }

  ValueDescription description_;
  std::vector<std::function<void(T&, const DocumentNode&)>> readers_;
  std::vector<std::function<WrittenMember(const T&, Writing&)>> writers_;
  Written unwritten_;  ///< of the next row: what it writes where its key is left out
  std::vector<std::function<void(T&)>> defaults_;
  std::vector<std::function<void(const T&, const DocumentNode&)>> checks_;
};

/// Whether the node's JSON type is one that the description takes.
bool has_form(const DocumentNode& node, const ValueDescription& description);

/// A value that may be written in forms of different JSON types, chosen by the type found.
template <class W>
SchemaType<W> either(const SchemaType<W>& first, const SchemaType<W>& second) {
  auto description = cases_description({first.description, second.description});
  return {description,
          [description, first, second](const DocumentNode& node) {
            if (has_form(node, *first.description)) return first.read(node);
            if (has_form(node, *second.description)) return second.read(node);
            node.fail_expected(description->expected);
          },
          [first, second](const W& value, Writing& writing) {
            Written written = first.write(value, writing);
            if (!written) writing.fault.clear();
            return written ? written : second.write(value, writing);
          }};
}

/// One of several objects, told apart by the keys (tags) that only they have.
template <class W>
SchemaType<W> tagged(const std::vector<std::pair<std::vector<std::string>, SchemaType<W>>>& cases,
                     int fallback = -1) {
  std::vector<ValueDescriptionPtr> descriptions;
  std::vector<std::vector<std::string>> tags;
  for (const auto& [keys, type] : cases) {
    descriptions.push_back(type.description);
    tags.push_back(keys);
  }
  auto description = cases_description(std::move(descriptions));
  return {description,
          [description, tags, cases, fallback](const DocumentNode& node) {
            const int index = find_case(node, *description, tags, fallback);
            return cases[static_cast<std::size_t>(index)].second.read(node);
          },
          [cases](const W& value, Writing& writing) -> Written {
            for (const auto& one : cases) {
              writing.fault.clear();
              if (Written written = one.second.write(value, writing)) return written;
            }
            return std::nullopt;
          }};
}

}  // namespace ifov::io
