#include "io/document/samplers/error_size.h"

#include "core/format.h"
#include "io/document/schema/record.h"

namespace ifov::io {

std::string text_of(const ErrorSize& error) {
  switch (error.unit) {
    case ErrorSize::Unit::kelvin: return format("{:g} K", error.value);
    case ErrorSize::Unit::radiance: return format("{:g} W m-2 sr-1 um-1", error.value);
    case ErrorSize::Unit::fraction: return format("{:g} %", 100.0 * error.value);
    case ErrorSize::Unit::reflectance: return format("{:g} reflectance", error.value);
    case ErrorSize::Unit::noise: return format("{:g} of the sensor's noise", error.value);
    case ErrorSize::Unit::polarization: return format("{:g} % DoLP", 100.0 * error.value);
  }
  return {};
}

SchemaType<ErrorSize> error_size_type(const std::vector<ErrorUnit>& allowed) {
  ValueDescription d;
  d.form = ValueDescription::Form::alternatives;
  std::string examples, units;
  for (const ErrorUnit& one : allowed) {
    ValueDescription text;
    text.expected = std::string(one.dimension->name);
    text.short_name = text.expected.substr(2);
    text.pattern = quantity_pattern(*one.dimension, Sign::positive);
    d.alternatives.push_back(std::make_shared<const ValueDescription>(std::move(text)));
    examples += format("{}\"{}\"", examples.empty() ? "" : ", ", one.dimension->example);
    units += format("{}{}", units.empty() ? "" : ", ", one.dimension->unit_list());
  }
  d.expected = format("a size above 0 with its unit, such as {} (units: {})", examples, units);
  d.short_name = format("size in {}", units);
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {description,
          [description, allowed](const DocumentNode& node) {
            if (node.type() == DocumentNode::Type::text) {
              const std::optional<QuantityText> parts = split_quantity(node.text());
              for (const ErrorUnit& one : allowed) {
                if (!parts || one.dimension->find(parts->unit) == nullptr) continue;
                const Range positive = Range::above(0.0, one.dimension->units[0].spelling);
                return ErrorSize{read_quantity(node, *one.dimension, positive, description->expected),
                                 one.unit, node.position()};
              }
            }
            node.fail_expected(description->expected);
          },
          [allowed](const ErrorSize& error, Writing&) -> Written {
            for (const ErrorUnit& one : allowed)
              if (one.unit == error.unit)
                return quantity_text(error.value, *one.dimension,
                                     Range::above(0.0, one.dimension->units[0].spelling));
            return std::nullopt;
          }};
}

}  // namespace ifov::io
