#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/document/document_values.h"
#include "io/document/schema/quantity.h"
#include "io/document/schema/value_description.h"
#include "io/document/schema/writing.h"
#include "io/json/node.h"
#include "math/vec3.h"

namespace ifov::io {

template <class Signature>
class SharedFunction;

/// A function that its copies share: what a type captures of others, and those of others, is not copied with it. There are
/// some thousand of them, each made of a lambda of its own, so that what std::function and std::make_shared instantiate for
/// each would take the compiler longer than all the rest.
template <class Result, class... Arguments>
class SharedFunction<Result(Arguments...)> {
 public:
  template <class F>
  requires(!std::is_same_v<F, SharedFunction>) SharedFunction(F function)  // implicit, as std::function's
      : held_(static_cast<const void*>(new F(std::move(function))), &destroy<F>), call_(&call<F>) {}
  Result operator()(Arguments... arguments) const {
    return call_(held_.get(), std::forward<Arguments>(arguments)...);
  }

 private:
  template <class F>
  static void destroy(const void* function) {
    delete static_cast<const F*>(function);
  }
  template <class F>
  static Result call(const void* function, Arguments... arguments) {
    return (*static_cast<const F*>(function))(std::forward<Arguments>(arguments)...);
  }

  std::shared_ptr<const void> held_;
  Result (*call_)(const void*, Arguments...);
};

/// How a value of a document is described, read as a V and written. `read` throws InputError. What `write` gives is read
/// as the same value; it gives nothing for a value that no text of this kind gives.
template <class V>
struct SchemaType {
  using Read = SharedFunction<V(const DocumentNode&)>;
  using Write = SharedFunction<Written(const V&, Writing&)>;

  SchemaType(ValueDescriptionPtr what, Read reads, Write writes)
      : description(std::move(what)), read(std::move(reads)), write(std::move(writes)) {}

  ValueDescriptionPtr description;
  Read read;
  Write write;
};

/// Allowed numbers, in the unit named (a spelling of the dimension; empty for plain numbers).
struct Range {
  std::optional<double> minimum, maximum;
  bool above_minimum = false;
  bool below_maximum = false;
  std::string_view unit;

  static Range at_least(double low, std::string_view unit = {}) { return {low, {}, false, false, unit}; }
  static Range above(double low, std::string_view unit = {}) { return {low, {}, true, false, unit}; }
  static Range between(double low, double high, std::string_view unit = {}) {
    return {low, high, false, false, unit};
  }
};

SchemaType<bool> boolean();
SchemaType<std::int64_t> long_integer(std::int64_t least, std::int64_t most);
SchemaType<int> integer(int least, int most);
SchemaType<double> number(const Range& range = {});

/// A text such as "1 m"; the result is in the unit that the dimension's comment names, times `factor`.
SchemaType<double> quantity(const Dimension& dimension, const Range& range = {}, double factor = 1.0);

/// A number such as 0.002, or a text such as "0.2 %".
SchemaType<double> fraction(const Range& range);

/// Any text that is not empty, at most 200 bytes, without control characters.
SchemaType<std::string> label();
SchemaType<std::string> text_like(std::string pattern, std::string expected, std::string short_name);

/// A name of something declared elsewhere in the document: "a material".
SchemaType<DocumentName> name_of(const std::string& what);
SchemaType<DocumentFile> file();

/// Three coordinates with units; displacements likewise.
SchemaType<math::Point3> point();
SchemaType<math::Vec3> displacement();

/// Three plain numbers, not all zero.
SchemaType<math::Vec3> direction();

/// The text of a node that must be one; fails with what the description expects.
const std::string& text_of(const DocumentNode& node, const ValueDescription& description);

/// Reads a quantity and checks its range; `expected` is for the message.
double read_quantity(const DocumentNode& node, const Dimension& dimension, const Range& range,
                     std::string_view expected);

/// The short text that read_quantity, times `factor`, makes this value of: exactly, where one does; nothing out of range.
std::optional<std::string> quantity_text(double value, const Dimension& dimension, const Range& range,
                                         double factor = 1.0);

/// Whether a quantity is within a range: its value in the dimension's own unit, and the number as written in `unit`.
bool is_within(double value, double number, const Unit& unit, const Dimension& dimension, const Range& range);
/// Whether a number is.
bool is_within(double value, const Range& range);
/// Whether a number is neither beyond reason nor, where it must be above zero, too near to that.
bool is_sensible(double value, const Range& range, double smallest, double largest);

/// Whether a list or a map of so many has a length that the description takes.
bool takes_count(const ValueDescription& description, std::size_t count);

/// Fails unless the node is a list (an object) with a count within the description's bounds.
void check_list(const DocumentNode& node, const ValueDescription& description);
void check_map(const DocumentNode& node, const ValueDescription& description);

ValueDescriptionPtr list_description(ValueDescriptionPtr items, std::size_t least, std::size_t most);
ValueDescriptionPtr map_description(ValueDescriptionPtr items, const std::string& of_what, std::size_t most);
ValueDescriptionPtr choice_description(std::vector<std::string> names);
std::size_t choice_index(const DocumentNode& node, const ValueDescription& description);

/// One of a few words.
template <class E>
SchemaType<E> choice(const std::vector<std::pair<std::string, E>>& words) {
  std::vector<std::string> names;
  std::vector<E> values;
  for (const auto& [name, value] : words) {
    names.push_back(name);
    values.push_back(value);
  }
  auto description = choice_description(std::move(names));
  return {
      description,
      [description, values](const DocumentNode& node) { return values[choice_index(node, *description)]; },
      [description, values](const E& value, Writing&) -> Written {
        for (std::size_t i = 0; i < values.size(); ++i)
          if (values[i] == value) return description->choices[i];
        return std::nullopt;
      }};
}

/// Writes the items of a list, all or none.
template <class Items, class V>
Written written_list(const Items& items, const SchemaType<V>& item, Writing& writing) {
  JsonValue::List list;
  for (const V& value : items) {
    Written one = item.write(value, writing);
    if (!one) {
      writing.is_within(list.size());
      return std::nullopt;
    }
    list.push_back(std::move(*one));
  }
  return list;
}

template <class V>
SchemaType<std::vector<V>> list(const SchemaType<V>& item, std::size_t least, std::size_t most) {
  auto description = list_description(item.description, least, most);
  return {description,
          [description, read = item.read](const DocumentNode& node) {
            check_list(node, *description);
            std::vector<V> values;
            values.reserve(node.items().size());
            for (const DocumentNode& child : node.items()) values.push_back(read(child));
            return values;
          },
          [description, item](const std::vector<V>& values, Writing& writing) -> Written {
            if (!takes_count(*description, values.size())) return std::nullopt;
            return written_list(values, item, writing);
          }};
}

template <class V, std::size_t N>
SchemaType<std::array<V, N>> tuple(const SchemaType<V>& item) {
  auto description = list_description(item.description, N, N);
  return {description,
          [description, read = item.read](const DocumentNode& node) {
            check_list(node, *description);
            std::array<V, N> values{};
            for (std::size_t i = 0; i < N; ++i) values[i] = read(node.items()[i]);
            return values;
          },
          [item](const std::array<V, N>& values, Writing& writing) {
            return written_list(values, item, writing);
          }};
}

/// An object whose keys the user chooses; `of_what` names them: "materials".
template <class V>
SchemaType<std::vector<std::pair<std::string, V>>> map_of(const SchemaType<V>& item,
                                                          const std::string& of_what, std::size_t most) {
  auto description = map_description(item.description, of_what, most);
  return {
      description,
      [description, read = item.read](const DocumentNode& node) {
        check_map(node, *description);
        std::vector<std::pair<std::string, V>> values;
        for (const DocumentNode& child : node.members()) {
          child.mark_read();
          values.emplace_back(child.key(), read(child));
        }
        return values;
      },
      [description, item](const std::vector<std::pair<std::string, V>>& values, Writing& writing) -> Written {
        if (!takes_count(*description, values.size())) return std::nullopt;
        JsonValue::Members members;
        for (const auto& [name, value] : values) {
          Written one = item.write(value, writing);
          if (!one) {
            writing.is_within(name);
            return std::nullopt;
          }
          members.emplace_back(name, std::move(*one));
        }
        return members;
      }};
}

/// The same value read as another type. `back` gives what is written, or an optional of it: nothing for what this cannot
/// tell.
template <class W, class V, class Convert, class Back>
SchemaType<W> converted(const SchemaType<V>& type, Convert convert, Back back) {
  return {type.description,
          [read = type.read, convert](const DocumentNode& node) -> W { return convert(read(node)); },
          [write = type.write, back](const W& value, Writing& writing) -> Written {
            const std::optional<V> from = back(value);
            return from ? write(*from, writing) : std::nullopt;
          }};
}

/// The same value, whose position is kept: made by `make(V, node)`, of which `back` gives the value or an optional of it.
template <class W, class V, class Make, class Back>
SchemaType<W> located(const SchemaType<V>& type, Make make, Back back) {
  return {type.description,
          [read = type.read, make](const DocumentNode& node) -> W { return make(read(node), node); },
          [write = type.write, back](const W& value, Writing& writing) -> Written {
            const std::optional<V> from = back(value);
            return from ? write(*from, writing) : std::nullopt;
          }};
}

}  // namespace ifov::io
