#include <map>

#include "core/error.h"
#include "io/document/parameter_map_document.h"
#include "io/document/scene_document.h"
#include "io/document/schema/record.h"
#include "io/document/tables/map_tables.h"
#include "io/document/tables/tables.h"
#include "materials/bsdf/bsdf_model.h"

namespace ifov::io {
namespace {

using materials::BsdfModel;
using materials::BsdfParameter;

/// Adds the key of a parameter whose value is stored as it is read.
template <class V, class Place>
void add_key(Record<ScatteringDocument>& record, const BsdfParameter& parameter, const SchemaType<V>& type,
             const Place& place) {
  const std::string key(parameter.key), doc(parameter.doc), fallback(parameter.default_json);
  if (parameter.optional)
    record.optional(key, place, type, doc);
  else if (fallback.empty())
    record.required(key, place, type, doc);
  else
    record.with_default(key, place, type, fallback, doc);
}

template <class V>
void add(Record<ScatteringDocument>& record, const BsdfParameter& parameter, const SchemaType<V>& type) {
  const std::string key(parameter.key);
  const auto place = via(
      [key](ScatteringDocument& to, V value) {
        std::erase_if(to.values, [&](const auto& known) { return known.first == key; });
        to.values.emplace_back(key, std::move(value));
      },
      [key](const ScatteringDocument& from) -> const V* {
        for (const auto& [known, value] : from.values)
          if (known == key) return std::get_if<V>(&value);
        return nullptr;
      });
  const auto read = [key, given = type.read](const DocumentNode& node) {
    if (node.type() == DocumentNode::Type::object && node.find("map") != nullptr)
      node.find("map")->fail_at_key(
          format("'{}' cannot be a map: of a model's parameters numbers, angles and lengths can", key));
    return given(node);
  };
  add_key(record, parameter, SchemaType<V>{type.description, read, type.write}, place);
}

/// A parameter that is one number everywhere, or a map.
void add_scalar(Record<ScatteringDocument>& record, const BsdfParameter& parameter,
                const SchemaType<double>& plain, ParameterKind kind) {
  using Value = ScatteringDocument::Value;
  const std::string key(parameter.key);
  const auto place = via(
      [key](ScatteringDocument& to, Value value) {
        std::erase_if(to.values, [&](const auto& known) { return known.first == key; });
        to.values.emplace_back(key, std::move(value));
      },
      [key](const ScatteringDocument& from) -> const Value* {
        for (const auto& [known, value] : from.values)
          if (known == key) return &value;
        return nullptr;
      });
  const SchemaType<ParameterMap> map = parameter_map_type(kind);
  const std::string what = kind == ParameterKind::number  ? "number"
                           : kind == ParameterKind::angle ? "angle"
                                                          : "length";
  Record<Value> mapped(what + " by a map", "A parameter that differs from place to place.");
  mapped.required(
      "map",
      via([](Value& to, ParameterMap value) { to = std::make_shared<const ParameterMap>(std::move(value)); },
          [](const Value& from) {
            const auto* shared = std::get_if<std::shared_ptr<const ParameterMap>>(&from);
            return shared != nullptr ? shared->get() : nullptr;
          }),
      map, "the raster");
  const auto number = converted<Value>(
      plain, [](double value) { return Value(value); },
      [](const Value& value) {
        const double* one = std::get_if<double>(&value);
        return one ? std::optional(*one) : std::nullopt;
      });
  const SchemaType<Value> mapped_type = mapped.type(), both = either(number, mapped_type);
  // A number without its unit is told as that.
  const auto read = [number, mapped_type](const DocumentNode& node) {
    return node.type() == DocumentNode::Type::object ? mapped_type.read(node) : number.read(node);
  };
  add_key(record, parameter, SchemaType<Value>{both.description, read, both.write}, place);
}

SchemaType<ScatteringDocument> parameters_type(const BsdfModel& model) {
  Record<ScatteringDocument> record(std::string(model.key), std::string(model.doc) + ".");
  for (const BsdfParameter& parameter : model.parameters) switch (parameter.form) {
      case BsdfParameter::Form::number:
        add_scalar(record, parameter, number(Range::between(parameter.low, parameter.high)),
                   ParameterKind::number);
        break;
      case BsdfParameter::Form::angle:
        add_scalar(record, parameter, quantity(kAngle, Range::between(parameter.low, parameter.high, "deg")),
                   ParameterKind::angle);
        break;
      case BsdfParameter::Form::length:
        add_scalar(record, parameter, quantity(kLength, Range::between(parameter.low, parameter.high, "mm")),
                   ParameterKind::length);
        break;
      case BsdfParameter::Form::spectrum:
        add(record, parameter,
            spectrum_type(parameter.low == 0.0 && parameter.high == 1.0 ? SpectrumOf::fraction
                                                                        : SpectrumOf::number));
        break;
      case BsdfParameter::Form::word: {
        std::vector<std::pair<std::string, std::string>> words;
        for (const std::string_view word : parameter.choices()) words.emplace_back(word, word);
        add(record, parameter, choice<std::string>(words));
        break;
      }
      case BsdfParameter::Form::brdf_file: add(record, parameter, file()); break;
      case BsdfParameter::Form::flag: add(record, parameter, boolean()); break;
    }
  return record.type();
}

/// "\"k\": ..., \"asymmetry\": ...".
std::string needed_keys(const BsdfModel& model) {
  std::string keys;
  for (const BsdfParameter& parameter : model.parameters)
    if (parameter.default_json.empty() && !parameter.optional)
      keys += format("{}\"{}\": ...", keys.empty() ? "" : ", ", parameter.key);
  return keys;
}

/// A model by its name alone: none of its parameters has to be given, or is written where all are what they are then.
SchemaType<ScatteringDocument> named_type() {
  std::vector<std::pair<std::string, std::string>> words;
  std::map<std::string, SchemaType<ScatteringDocument>> parameters;
  for (const BsdfModel* model : materials::bsdf_models()) {
    if (model->needs_parameters()) continue;
    words.emplace_back(model->key, model->key);
    parameters.emplace(model->key, parameters_type(*model));
  }
  const SchemaType<std::string> named = choice<std::string>(words);
  const auto read = [named, parameters](const DocumentNode& node) {
    for (const BsdfModel* model : materials::bsdf_models())
      if (model->needs_parameters() && node.type() == DocumentNode::Type::text && node.text() == model->key)
        node.fail(format("{} is '{}', which needs its parameters: {{\"{}\": {{{}}}}}", node.title(),
                         model->key, model->key, needed_keys(*model)));
    const std::string name = named.read(node);
    const DocumentTree nothing = parse_json("{}", "no parameters");
    return ScatteringDocument{name, parameters.at(name).read(*nothing.root).values};
  };
  const auto write = [named, parameters](const ScatteringDocument& scattering, Writing& writing) -> Written {
    const auto model = parameters.find(scattering.model);
    if (model == parameters.end()) return std::nullopt;
    const bool is_told = model->second.write(scattering, writing) == JsonValue(JsonValue::Members());
    return is_told ? named.write(scattering.model, writing) : std::nullopt;
  };
  return {named.description, read, write};
}

/// What is wrong with the name of a model, or with parameters under it; empty: nothing.
std::string fault_of(std::string_view name, bool has_parameters) {
  try {
    const BsdfModel& model = materials::bsdf_model(name);
    return has_parameters && model.parameters.empty()
               ? format("'{}' has no parameters: write \"scattering\": \"{}\"", name, name)
               : std::string();
  } catch (const InputError& error) {
    return error.what();
  }
}

void check_model(const DocumentNode& node) {
  if (node.type() == DocumentNode::Type::text) {
    if (const std::string fault = fault_of(node.text(), false); !fault.empty()) node.fail(fault);
  } else if (node.type() == DocumentNode::Type::object) {
    for (const DocumentNode& member : node.members())
      if (const std::string fault = fault_of(member.name(), true); !fault.empty()) member.fail_at_key(fault);
  }
}

}  // namespace

bool reflects_by_itself(const ScatteringDocument& scattering) {
  return materials::bsdf_model(scattering.model).reflectance_is_factor;
}

SchemaType<ScatteringDocument> scattering_type() {
  Record<ScatteringDocument> with_parameters("scattering", "A model with its parameters, under its name.");
  with_parameters.exactly_one();
  bool any = false;
  for (const BsdfModel* model : materials::bsdf_models()) {
    if (model->parameters.empty()) continue;
    const std::string key(model->key);
    any = true;
    with_parameters.one(
        key,
        via(
            [key](ScatteringDocument& to, ScatteringDocument with) {
              to = {key, std::move(with.values)};
            },
            [key](const ScatteringDocument& from) { return from.model == key ? &from : nullptr; }),
        parameters_type(*model), std::string(model->doc));
  }
  if (!any) return named_type();
  const SchemaType<ScatteringDocument> both = either(named_type(), with_parameters.type());
  const auto read = [given = both.read](const DocumentNode& node) {
    check_model(node);
    return given(node);
  };
  return {both.description, read, both.write};
}

}  // namespace ifov::io
