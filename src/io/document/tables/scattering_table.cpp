#include "core/format.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"
#include "materials/bsdf/bsdf_model.h"

namespace ifov::io {
namespace {

using materials::BsdfModel;
using materials::BsdfParameter;

template <class V>
void add(Record<ScatteringDocument>& record, const BsdfParameter& parameter, const Kind<V>& kind) {
  const std::string key(parameter.key), doc(parameter.doc), fallback(parameter.default_json);
  const auto store = [key](ScatteringDocument& to, V value) {
    to.values.emplace_back(key, std::move(value));
  };
  if (parameter.optional)
    record.optional(key, store, kind, doc);
  else if (fallback.empty())
    record.required(key, store, kind, doc);
  else
    record.with_default(
        key,
        [key, store](ScatteringDocument& to, V value) {
          std::erase_if(to.values, [&](const auto& known) { return known.first == key; });
          store(to, std::move(value));
        },
        kind, fallback, doc);
}

Kind<ScatteringDocument> parameters_kind(const BsdfModel& model) {
  Record<ScatteringDocument> record(std::string(model.key), std::string(model.doc) + ".");
  for (const BsdfParameter& parameter : model.parameters) switch (parameter.form) {
      case BsdfParameter::Form::number:
        add(record, parameter, number(Range::between(parameter.low, parameter.high)));
        break;
      case BsdfParameter::Form::angle:
        add(record, parameter, quantity(kAngle, Range::between(parameter.low, parameter.high, "deg")));
        break;
      case BsdfParameter::Form::spectrum: add(record, parameter, spectrum_kind(SpectrumOf::fraction)); break;
    }
  return record.kind();
}

/// A model by its name alone: none of its parameters has to be given.
Kind<ScatteringDocument> named_kind() {
  std::vector<std::pair<std::string, ScatteringDocument>> models;
  const DocumentTree nothing = parse_json("{}", "no parameters");
  for (const BsdfModel* model : materials::bsdf_models())
    if (!model->needs_parameters())
      models.push_back({std::string(model->key),
                        {std::string(model->key), parameters_kind(*model).read(*nothing.root).values}});
  const Kind<ScatteringDocument> named = choice<ScatteringDocument>(models);
  return {named.description, [named](const DocumentNode& node) {
            for (const BsdfModel* model : materials::bsdf_models())
              if (model->needs_parameters() && node.type() == DocumentNode::Type::text &&
                  node.text() == model->key)
                node.fail(format("{} is '{}', which needs its parameters: {{\"{}\": {{\"{}\": ...}}}}",
                                 node.title(), model->key, model->key, model->parameters.front().key));
            return named.read(node);
          }};
}

}  // namespace

Kind<ScatteringDocument> scattering_kind() {
  Record<ScatteringDocument> with_parameters("scattering", "A model with its parameters, under its name.");
  with_parameters.exactly_one();
  bool any = false;
  for (const BsdfModel* model : materials::bsdf_models()) {
    if (model->parameters.empty()) continue;
    const std::string key(model->key);
    any = true;
    with_parameters.one(
        key,
        [key](ScatteringDocument& to, ScatteringDocument with) {
          to = {key, std::move(with.values)};
        },
        parameters_kind(*model), std::string(model->doc));
  }
  return any ? either(named_kind(), with_parameters.kind()) : named_kind();
}

}  // namespace ifov::io
