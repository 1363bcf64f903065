#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/document/scene_document.h"

namespace ifov::io {

/// A model of materials::bsdf_models() as the tables that read documents tell of it.
struct ScatteringModelText {
  struct Parameter {
    std::string key, doc;
    std::string value;         ///< what it may be: "angle between 0 and 60 deg"
    std::string default_json;  ///< empty: none
    bool required = false;
  };
  std::string key, doc;
  std::string
      usual_reflectance;  ///< of a surface by this model when nothing is said of it, as documents write it
  std::vector<Parameter> parameters;
};

/// In the order of the registry.
std::vector<ScatteringModelText> scattering_models();
/// Throws InputError, with the choices, where there is none of that key.
ScatteringModelText scattering_model(const std::string& key);

/// Parameters as documents write them, without quotation marks: ("slope", "20 deg"). Spectra are left out.
std::vector<std::pair<std::string, std::string>> parameter_texts(const ScatteringDocument& scattering);

/// A line for each model and each parameter, for a terminal: at most 110 columns.
std::string list_scattering_models(const std::vector<ScatteringModelText>& models);

/// The same as tables in Markdown; docs/guide/surfaces.md holds them.
std::string scattering_models_markdown(const std::vector<ScatteringModelText>& models);

}  // namespace ifov::io
