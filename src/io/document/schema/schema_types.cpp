#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "core/names.h"
#include "io/document/schema/schema_type.h"

namespace ifov::io {
namespace {

using Form = ValueDescription::Form;
using Type = DocumentNode::Type;

constexpr double kSmallest = 1e-15, kLargest = 1e15;  // of plain numbers

/// "0.1 nm", "10 m": millimetres in a unit in which they are no long number.
std::string length_text(double mm) {
  struct Length {
    std::string_view unit;
    double mm;
  };
  for (const Length& length : {Length{"m", 1e3}, {"mm", 1.0}, {"um", 1e-3}})
    if (mm >= length.mm) return format("{:.6g} {}", mm / length.mm, length.unit);
  return format("{:.6g} nm", mm * 1e6);
}

/// " above 0 m", " between -90 and 90 deg", or nothing.
std::string range_text(const Range& range) {
  if (range.unit == "mm" && range.minimum && range.maximum &&
      (*range.minimum < 0.01 || *range.maximum > 1000.0))
    return format(" between {} and {}", length_text(*range.minimum), length_text(*range.maximum));
  const std::string unit = range.unit.empty() ? "" : format(" {}", range.unit);
  if (range.minimum && range.maximum) {
    const std::string_view low = range.above_minimum ? " (excluded)" : "";
    const std::string_view high = range.below_maximum ? " (excluded)" : "";
    return format(" between {}{} and {}{}{}", *range.minimum, low, *range.maximum, unit, high);
  }
  if (range.minimum)
    return format(" {} {}{}", range.above_minimum ? "above" : "of at least", *range.minimum, unit);
  if (range.maximum)
    return format(" {} {}{}", range.below_maximum ? "below" : "of at most", *range.maximum, unit);
  return {};
}

/// Durations go from microseconds to weeks: one of what is asked for.
std::string example_of(const Dimension& dimension, const Range& range) {
  const bool one = &dimension == &kDuration && !range.unit.empty() && is_within(1.0, range);
  return one ? format("1 {}", range.unit) : std::string(dimension.example);
}

Sign sign_of(const Range& range, const Dimension& dimension) {
  const Unit* unit = range.unit.empty() ? nullptr : dimension.find(range.unit);
  const bool signless = std::all_of(dimension.units.begin(), dimension.units.end(),
                                    [](const Unit& u) { return u.offset == 0.0; });
  if (!signless || !range.minimum || *range.minimum < 0.0 || unit == nullptr) return Sign::any;
  return range.above_minimum || *range.minimum > 0.0 ? Sign::positive : Sign::not_negative;
}

std::string without_article(std::string_view name) {
  return std::string(name.substr(std::min(name.size(), name.find(' ') + 1)));
}

/// "1,5 m": a decimal comma, which ends a number here.
bool has_decimal_comma(std::string_view unit) {
  return unit.size() > 1 && unit[0] == ',' && unit[1] >= '0' && unit[1] <= '9';
}

void set_range(ValueDescription& description, const Range& range) {
  description.minimum = range.minimum;
  description.maximum = range.maximum;
  description.above_minimum = range.above_minimum;
  description.below_maximum = range.below_maximum;
}

}  // namespace

bool is_within(double value, const Range& range) {
  const bool low = !range.minimum || (range.above_minimum ? value > *range.minimum : value >= *range.minimum);
  const bool high =
      !range.maximum || (range.below_maximum ? value < *range.maximum : value <= *range.maximum);
  return low && high;
}

bool is_within(double value, double number, const Unit& unit, const Dimension& dimension,
               const Range& range) {
  const Unit* limit_unit = range.unit.empty() ? nullptr : dimension.find(range.unit);
  const double in_limit_unit = &unit == limit_unit ? number
                               : limit_unit        ? (value - limit_unit->offset) / limit_unit->factor
                                                   : value;
  return std::isfinite(value) && is_within(in_limit_unit, range);
}

bool is_sensible(double value, const Range& range, double smallest, double largest) {
  const bool must_be_positive = range.above_minimum && range.minimum == 0.0;
  return std::isfinite(value) && std::abs(value) <= largest && (!must_be_positive || value >= smallest);
}

const std::string& text_of(const DocumentNode& node, const ValueDescription& description) {
  if (node.type() != Type::text) node.fail_expected(description.expected);
  return node.text();
}

double read_quantity(const DocumentNode& node, const Dimension& dimension, const Range& range,
                     std::string_view expected) {
  if (node.type() == Type::number) {
    node.fail(format("{} is {} without a unit, expected {}", node.title(), node.found(), expected));
  }
  if (node.type() != Type::text) node.fail_expected(expected);
  const std::optional<QuantityText> parts = split_quantity(node.text());
  if (!parts) node.fail_expected(expected);
  if (parts->unit.empty()) {
    node.fail(format("{} is {} without a unit, expected {}", node.title(), node.found(), expected));
  }
  if (has_decimal_comma(parts->unit))
    node.fail(format("{} is {}: decimals follow a point, such as \"{}.{}\"", node.title(), node.found(),
                     parts->number, parts->unit.substr(1)));
  const Unit* unit = dimension.find(parts->unit);
  if (unit == nullptr) {
    std::vector<std::string> spellings;
    for (const Unit& known : dimension.units) spellings.emplace_back(known.spelling);
    node.fail(format(
        "{} is {}: '{}' is not a unit of {}{} Units: {}", node.title(), node.found(), parts->unit,
        without_article(dimension.name),
        [&] {
          const std::string hint = did_you_mean(parts->unit, spellings);
          return hint.empty() ? std::string(".") : hint;
        }(),
        dimension.unit_list()));
  }
  const double value = parts->number * unit->factor + unit->offset;
  if (!is_within(value, parts->number, *unit, dimension, range)) node.fail_expected(expected);
  if (!is_sensible(value, range, dimension.smallest, dimension.largest)) {
    const Unit& first = dimension.units.front();
    node.fail(format(
        "{} is {}, which is too {}: {} here is {} {:g} {}", node.title(), node.found(),
        std::abs(value) > dimension.largest ? "large" : "small", dimension.name,
        std::abs(value) > dimension.largest ? "at most" : "at least",
        ((std::abs(value) > dimension.largest ? dimension.largest : dimension.smallest) - first.offset) /
            first.factor,
        first.spelling));
  }
  return value;
}

SchemaType<bool> boolean() {
  ValueDescription d;
  d.form = Form::boolean;
  d.expected = "true or false";
  d.short_name = "true or false";
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {description,
          [description](const DocumentNode& node) {
            if (node.type() != Type::boolean) node.fail_expected(description->expected);
            return node.boolean();
          },
          [](bool value, Writing&) { return JsonValue(value); }};
}

SchemaType<std::int64_t> long_integer(std::int64_t least, std::int64_t most) {
  ValueDescription d;
  d.form = Form::integer;
  d.expected = format("an integer between {} and {}", least, most);
  d.short_name = format("integer, {} to {}", least, most);
  d.minimum = static_cast<double>(least);
  d.maximum = static_cast<double>(most);
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {description,
          [description, least, most](const DocumentNode& node) {
            if (node.type() != Type::number || !node.is_integer()) node.fail_expected(description->expected);
            if (node.integer() < least || node.integer() > most) node.fail_expected(description->expected);
            return node.integer();
          },
          [least, most](std::int64_t value, Writing&) {
            return value >= least && value <= most ? Written(value) : std::nullopt;
          }};
}

SchemaType<int> integer(int least, int most) {
  return converted<int>(
      long_integer(least, most), [](std::int64_t value) { return static_cast<int>(value); },
      [](int value) { return std::int64_t{value}; });
}

SchemaType<double> number(const Range& range) {
  ValueDescription d;
  d.form = Form::number;
  d.expected = format("a number{}", range_text(range));
  d.short_name = d.expected.substr(2);
  set_range(d, range);
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {description,
          [description, range](const DocumentNode& node) {
            const bool is_share = range.minimum == 0.0 && range.maximum == 1.0;
            if (node.type() == Type::number && is_share && node.number() > 1.0 && node.number() <= 100.0)
              node.fail(format("{} is {}, expected {}; {:g} % is {:g}", node.title(), node.found(),
                               description->expected, node.number(), node.number() / 100.0));
            if (node.type() != Type::number || !is_within(node.number(), range))
              node.fail_expected(description->expected);
            if (!is_sensible(node.number(), range, kSmallest, kLargest))
              node.fail(format("{} is {}, which is too {} to mean anything: expected {:g} to {:g}",
                               node.title(), node.found(),
                               std::abs(node.number()) > kLargest ? "large" : "small", kSmallest, kLargest));
            return node.number();
          },
          [range](double value, Writing&) {
            const bool can_be_read =
                is_within(value, range) && is_sensible(value, range, kSmallest, kLargest);
            return can_be_read ? Written(value) : std::nullopt;
          }};
}

SchemaType<double> quantity(const Dimension& dimension, const Range& range, double factor) {
  ValueDescription d;
  d.form = Form::text;
  d.expected = format("{}{}, such as \"{}\" (units: {})", dimension.name, range_text(range),
                      example_of(dimension, range), dimension.unit_list());
  d.short_name = without_article(format("{}{}", dimension.name, range_text(range)));
  d.pattern = quantity_pattern(dimension, sign_of(range, dimension));
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {description,
          [description, &dimension, range, factor](const DocumentNode& node) {
            return factor * read_quantity(node, dimension, range, description->expected);
          },
          [&dimension, range, factor](double value, Writing&) -> Written {
            return quantity_text(value, dimension, range, factor);
          }};
}

SchemaType<double> fraction(const Range& range) {
  const SchemaType<double> plain = number(range);
  ValueDescription percent;
  percent.form = Form::text;
  percent.expected = "a percentage";
  percent.short_name = "percentage";
  percent.pattern = quantity_pattern(kPercent, range.above_minimum ? Sign::positive : Sign::not_negative);
  ValueDescription d;
  d.form = Form::alternatives;
  d.expected = format("{}, or a percentage such as \"1 %\"", plain.description->expected);
  d.short_name = format("{}, or percentage", plain.description->short_name);
  d.alternatives = {plain.description, std::make_shared<const ValueDescription>(std::move(percent))};
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {
      description,
      [description, range](const DocumentNode& node) {
        if (node.type() == Type::text) return read_quantity(node, kPercent, range, description->expected);
        if (node.type() != Type::number || !is_within(node.number(), range))
          node.fail_expected(description->expected);
        return node.number();
      },
      [range](double value, Writing&) { return is_within(value, range) ? Written(value) : std::nullopt; }};
}

SchemaType<math::Point3> point() {
  return converted<math::Point3>(
      tuple<double, 3>(quantity(kLength)),
      [](const std::array<double, 3>& c) {
        return math::Point3{c[0], c[1], c[2]};
      },
      [](math::Point3 p) {
        return std::array{p.x, p.y, p.z};
      });
}

SchemaType<math::Vec3> displacement() {
  return converted<math::Vec3>(
      tuple<double, 3>(quantity(kLength)),
      [](const std::array<double, 3>& c) {
        return math::Vec3{c[0], c[1], c[2]};
      },
      [](math::Vec3 v) {
        return std::array{v.x, v.y, v.z};
      });
}

SchemaType<math::Vec3> direction() {
  const SchemaType<std::array<double, 3>> numbers = tuple<double, 3>(number());
  return {numbers.description,
          [read = numbers.read](const DocumentNode& node) {
            const std::array<double, 3> c = read(node);
            const math::Vec3 vector{c[0], c[1], c[2]};
            const double length = math::length(vector);
            if (!(length > 0.0) || !std::isfinite(length)) {
              node.fail(format("{} has no direction: its length must be above 0", node.title()));
            }
            return vector;
          },
          [write = numbers.write](math::Vec3 v, Writing& writing) -> Written {
            if (!(math::length(v) > 0.0)) return std::nullopt;
            return write({v.x, v.y, v.z}, writing);
          }};
}

}  // namespace ifov::io
