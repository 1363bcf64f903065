#include "io/document/reading/scattering_models.h"

#include <algorithm>

#include "core/error.h"
#include "core/names.h"
#include "io/document/tables/tables.h"
#include "materials/bsdf/bsdf_model.h"

namespace ifov::io {
namespace {

constexpr std::size_t kWidth = 110;

/// "number between 0 and 1, or CSV spectrum".
std::string kinds_of(const ValueDescription& value) {
  if (value.form != ValueDescription::Form::alternatives)
    return value.form == ValueDescription::Form::record ? value.name : value.short_name;
  std::string text;
  for (const ValueDescriptionPtr& one : value.alternatives)
    text += (text.empty() ? "" : ", or ") + kinds_of(*one);
  return text;
}

/// The record of a model's parameters; null for a model that has none.
const ValueDescription* parameters_of(const ValueDescription& scattering, std::string_view model) {
  for (const ValueDescriptionPtr& one : scattering.alternatives)
    for (const FieldDescription& field : one->fields)
      if (field.key == model) return field.value.get();
  return nullptr;
}

std::string presence_of(const ScatteringModelText::Parameter& parameter) {
  if (parameter.required) return "required";
  return parameter.default_json.empty() ? "optional" : "default " + parameter.default_json;
}

/// Words in lines of at most kWidth letters, those after the first indented.
std::string wrapped_to_width(const std::string& first, const std::string& words, std::size_t indent) {
  std::string text, line = first;
  bool is_empty = true;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    if (!is_empty && line.size() + 1 + end - at > kWidth) {
      text += line + "\n";
      line.assign(indent, ' ');
      is_empty = true;
    }
    line += (is_empty ? "" : " ") + words.substr(at, end - at);
    is_empty = false;
    at = end + 1;
  }
  return text + line + "\n";
}

}  // namespace

std::vector<ScatteringModelText> scattering_models() {
  const ValueDescriptionPtr scattering = scattering_type().description;
  std::vector<ScatteringModelText> models;
  for (const materials::BsdfModel* model : materials::bsdf_models()) {
    ScatteringModelText& text = models.emplace_back();
    text.key = model->key;
    text.doc = model->doc;
    text.usual_reflectance = model->reflectance_is_factor ? "1" : "0.3";
    if (const ValueDescription* record = parameters_of(*scattering, model->key))
      for (const FieldDescription& field : record->fields)
        text.parameters.push_back(
            {field.key, field.doc, kinds_of(*field.value), field.default_json, field.required});
  }
  return models;
}

ScatteringModelText scattering_model(const std::string& key) {
  const std::string_view known = materials::bsdf_model(key).key;
  const std::vector<ScatteringModelText> models = scattering_models();
  return *std::ranges::find(models, known, &ScatteringModelText::key);
}

std::vector<std::pair<std::string, std::string>> parameter_texts(const ScatteringDocument& scattering) {
  constexpr std::size_t kLongest = 200;
  std::vector<std::pair<std::string, std::string>> texts;
  Writing writing;
  writing.all_keys = true;
  const Written written = scattering_type().write(scattering, writing);
  const auto* by_model = written ? std::get_if<JsonValue::Members>(&written->any()) : nullptr;
  if (by_model == nullptr) return texts;  // a name alone
  for (const auto& [key, value] : std::get<JsonValue::Members>(by_model->front().second.any())) {
    const auto known = std::find_if(scattering.values.begin(), scattering.values.end(),
                                    [&name = key](const auto& one) { return one.first == name; });
    if (known != scattering.values.end() && std::holds_alternative<SpectrumDocument>(known->second)) continue;
    if (const auto* text = std::get_if<std::string>(&value.any()))
      texts.emplace_back(key, *text);
    else
      texts.emplace_back(key, value.on_one_line(kLongest).value_or("..."));
  }
  return texts;
}

std::string list_scattering_models(const std::vector<ScatteringModelText>& models) {
  std::size_t widest = 0, widest_key = 0;
  for (const ScatteringModelText& model : models) {
    widest = std::max(widest, model.key.size());
    for (const auto& parameter : model.parameters) widest_key = std::max(widest_key, parameter.key.size());
  }
  std::string text;
  for (const ScatteringModelText& model : models) {
    text += wrapped_to_width(format("{:<{}}  ", model.key, widest), model.doc, widest + 2);
    for (const ScatteringModelText::Parameter& parameter : model.parameters)
      text += wrapped_to_width(format("    {:<{}}  ", parameter.key, widest_key),
                               format("{}, {}: {}", parameter.value, presence_of(parameter), parameter.doc),
                               widest_key + 6);
  }
  return text;
}

std::string scattering_models_markdown(const std::vector<ScatteringModelText>& models) {
  std::string text = "| model | what it is |\n|---|---|\n";
  for (const ScatteringModelText& model : models) text += format("| `{}` | {} |\n", model.key, model.doc);
  text += "\n| model | parameter | value | default | meaning |\n|---|---|---|---|---|\n";
  for (const ScatteringModelText& model : models)
    for (const ScatteringModelText::Parameter& parameter : model.parameters)
      text += format("| `{}` | `{}` | {} | {} | {} |\n", model.key, parameter.key, parameter.value,
                     parameter.required               ? "**required**"
                     : parameter.default_json.empty() ? "none"
                                                      : format("`{}`", parameter.default_json),
                     parameter.doc);
  return text;
}

}  // namespace ifov::io
