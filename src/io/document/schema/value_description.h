#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ifov::io {

struct ValueDescription;
using ValueDescriptionPtr = std::shared_ptr<const ValueDescription>;

/// One key of an object, as messages, the schema and the reference page tell of it.
struct FieldDescription {
  std::string key;
  std::string doc;  ///< one line
  ValueDescriptionPtr value;
  bool required = false;
  std::string default_json;  ///< empty: none
  int group = -1;            ///< index of the group of keys that exclude each other; -1: none
  /// Names that the key had: read for one version, with a hint.
  std::vector<std::string> former = {};
};

/// What a value of a document may be: the one table that reading, JSON Schema and reference page share.
struct ValueDescription {
  enum class Form { boolean, integer, number, text, list, map, record, alternatives };

  Form form = Form::text;
  std::string expected;    ///< completes "expected ...": "a length with its unit, such as \"1 m\""
  std::string short_name;  ///< for tables: "length"

  std::optional<double> minimum, maximum;  ///< of numbers
  bool above_minimum = false;              ///< the minimum itself is not allowed
  bool below_maximum = false;

  std::string pattern;               ///< of texts, of the keys of maps
  std::vector<std::string> choices;  ///< of texts; empty: any

  ValueDescriptionPtr items;  ///< of lists and maps
  std::size_t min_count = 0, max_count = 0;

  std::string name, doc;  ///< of records
  std::vector<FieldDescription> fields;
  std::vector<bool> group_required;                        ///< by group index: exactly one, else at most one
  std::vector<std::pair<std::string, std::string>> needs;  ///< the first key is given only beside the second

  std::vector<ValueDescriptionPtr> alternatives;  ///< any of these
};

}  // namespace ifov::io
