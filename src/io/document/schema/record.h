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

/// The rows of a Record, which alone knows the type of the values that are passed here by address: this is compiled once and
/// not for each record.
class RecordRows {
 public:
  /// What a row knows of its values' type: `row` says where a value goes and how it is read and written.
  struct Access {
    std::shared_ptr<const void> row;
    void (*read)(const void* row, void* record, const DocumentNode& member);
    /// Nothing for a value that is absent, or that is empty where `only_if_any`.
    WrittenMember (*write)(const void* row, const void* record, bool only_if_any, Writing&);
  };
  using SetDefault = SharedFunction<void(void* record)>;
  using Check = SharedFunction<void(const void* record, const DocumentNode&)>;

  RecordRows(std::string name, std::string doc);
  const ValueDescription& description() const { return description_; }
  std::shared_ptr<const RecordRows> shared() const;

  /// `unwritten` is what the row writes for what a record holds without its key.
  void add(FieldDescription field, Access access, Written unwritten);
  void add_default(SetDefault set) { defaults_.push_back(std::move(set)); }
  void add_check(Check check) { checks_.push_back(std::move(check)); }
  void add_group(bool is_required) { description_.group_required.push_back(is_required); }
  int last_group() const { return static_cast<int>(description_.group_required.size()) - 1; }
  void add_former_name(std::string name);
  void add_need(std::string key, std::string other);

  void read(void* record, const DocumentNode& node) const;

  /// An object of the rows' members. Nothing where one cannot be written or a required one is not given; of keys that
  /// exclude each other the first that can be is written. `only` some keys, or all where it is empty.
  Written written(const void* record, Writing& writing, std::span<const std::string> only) const;

 private:
  struct Row {
    Access access;
    Written unwritten;
  };

  WrittenMember written_member(std::size_t row, const void* record, Writing& writing) const;

  ValueDescription description_;
  std::vector<Row> rows_;  ///< one for each of the description's fields
  std::vector<SetDefault> defaults_;
  std::vector<Check> checks_;
};

/// The table of an object's keys: written once, it reads a T, writes it, and describes it for schema and reference.
template <class T>
class Record {
 public:
  Record(std::string name, std::string doc) : rows_(std::move(name), std::move(doc)) {}

  /// Where a value goes and comes from is said by its target (target.h).
  template <class V, class Target>
  Record& required(std::string key, Target target, const SchemaType<V>& type, std::string doc) {
    return add({std::move(key), std::move(doc), type.description, true, {}, -1}, target, type, std::nullopt);
  }

  template <class V, class Target>
  Record& optional(std::string key, Target target, const SchemaType<V>& type, std::string doc) {
    return add({std::move(key), std::move(doc), type.description, false, {}, -1}, target, type,
               unwritten<V>(target, type));
  }

  /// Without the key, the value is what this JSON text would have given.
  template <class V, class Target>
  Record& with_default(std::string key, Target target, const SchemaType<V>& type, std::string json,
                       std::string doc) {
    const DocumentTree tree = parse_json(json, "default of " + key);
    const V value = type.read(*tree.root);
    rows_.add_default([target, value](void* record) { store(*static_cast<T*>(record), target, value); });
    Writing writing;
    return add({std::move(key), std::move(doc), type.description, false, std::move(json), -1}, target, type,
               type.write(value, writing));
  }

  /// The cases that follow exclude each other: exactly one of them is given (at most one).
  Record& exactly_one() { return group(true, true); }
  Record& at_most_one() { return group(false, false); }
  /// At most one; a value is written whatever a T holds without the key (a check says when one is needed).
  Record& at_most_one_told() { return group(false, true); }

  template <class V, class Target>
  Record& one(std::string key, Target target, const SchemaType<V>& type, std::string doc) {
    return add({std::move(key), std::move(doc), type.description, false, {}, rows_.last_group()}, target,
               type, group_is_told_ ? std::nullopt : unwritten<V>(target, type));
  }

  /// The key above was called `name` and is still read under it (docs/developer/versions.md says how long).
  Record& formerly(std::string name) {
    rows_.add_former_name(std::move(name));
    return *this;
  }

  /// `key` is given only beside `other`.
  Record& needs(std::string key, std::string other) {
    rows_.add_need(std::move(key), std::move(other));
    return *this;
  }

  /// Called after all keys are read: (const T&, const DocumentNode&).
  template <class Condition>
  Record& check(Condition condition) {
    rows_.add_check([condition](const void* record, const DocumentNode& node) {
      condition(*static_cast<const T*>(record), node);
    });
    return *this;
  }

  SchemaType<T> type() const {
    const std::shared_ptr<const RecordRows> rows = rows_.shared();
    return {ValueDescriptionPtr(rows, &rows->description()),
            [rows](const DocumentNode& node) {
              T record{};
              if constexpr (requires { record.position = node.position(); })
                record.position = node.position();
              rows->read(&record, node);
              return record;
            },
            [rows](const T& record, Writing& writing) { return rows->written(&record, writing, {}); }};
  }

  /// The members of some keys alone; of all where there are none.
  Written written(const T& record, Writing& writing, std::span<const std::string> only) const {
    return rows_.written(&record, writing, only);
  }

 private:
  /// Without its key, a row says what a T has anyway: what that is needs no writing.
  template <class V, class Target>
  static Written unwritten(const Target& target, const SchemaType<V>& type) {
    const std::optional<V> value = load<V>(T{}, target);
    Writing writing;
    return value ? type.write(*value, writing) : std::nullopt;
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
  struct Row {
    Target target;
    typename SchemaType<V>::Read read;
    typename SchemaType<V>::Write write;

    static void destroy(const void* row) { delete static_cast<const Row*>(row); }
    static void read_member(const void* row, void* record, const DocumentNode& node) {
      const Row& self = *static_cast<const Row*>(row);
      store(*static_cast<T*>(record), self.target, self.read(node));
    }
    static WrittenMember written_member(const void* row, const void* record, bool only_if_any,
                                        Writing& writing) {
      const Row& self = *static_cast<const Row*>(row);
      const std::optional<V> value = load<V>(*static_cast<const T*>(record), self.target);
      if (!value || (only_if_any && is_nothing(*value))) return WrittenMember{};
      return WrittenMember{true, self.write(*value, writing)};
    }
  };

  template <class Target, class V>
  Record& add(FieldDescription field, Target target, const SchemaType<V>& type, Written unwritten) {
    using Held = Row<Target, V>;
    const void* row = new Held{std::move(target), type.read, type.write};
    rows_.add(std::move(field),
              {std::shared_ptr<const void>(row, &Held::destroy), &Held::read_member, &Held::written_member},
              std::move(unwritten));
    return *this;
  }

  Record& group(bool required, bool told) {
    rows_.add_group(required);
    group_is_told_ = told;
    return *this;
  }

  RecordRows rows_;
  bool group_is_told_ = true;  ///< of the last group: what is written does not depend on what a T{} holds
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
