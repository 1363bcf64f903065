#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "materials/bsdf/bsdf.h"
#include "materials/bsdf/bsdf_table.h"

namespace ifov::materials {

/// A parameter of a model, as documents state it.
struct BsdfParameter {
  enum class Form {
    number,
    angle,      ///< "20 deg" in documents, radians here
    length,     ///< "0.2 mm" in documents, metres here
    spectrum,   ///< numbers by wavelength
    word,       ///< one of `choices`
    brdf_file,  ///< name of a file in documents, a MeasuredBrdf here
    flag,       ///< true or false in documents, 1 or 0 here
  };
  std::string_view key, doc;
  Form form = Form::number;
  double low = 0.0, high = 1.0;        ///< of numbers; of angles in deg, of lengths in mm
  std::string_view default_json = {};  ///< empty: the document has to give it, unless it is optional
  bool optional = false;               ///< may be left out without a default; then the inputs lack it
  std::span<const std::string_view> (*choices)() = nullptr;  ///< of a word
};

/// What a model is made of: the material's reflectance, and the model's parameters by key.
struct BsdfInputs {
  using Value = std::variant<double, radiometry::Spectrum, std::string, MeasuredBrdf>;
  radiometry::Spectrum reflectance;
  std::vector<std::pair<std::string, Value>> values;
  /// Told what the model has changed of what it was given; may be empty.
  std::function<void(const std::string& change)> say = {};

  bool has(std::string_view key) const;
  /// Throw std::logic_error where the model has declared no such parameter of this form.
  double number(std::string_view key) const;
  const radiometry::Spectrum& spectrum(std::string_view key) const;
  const std::string& word(std::string_view key) const;
  const MeasuredBrdf& brdf(std::string_view key) const;
};

/// A model of the registry: whoever reads documents, explains them or makes materials asks this.
struct BsdfModel {
  std::string_view key, doc;  ///< in documents
  std::vector<BsdfParameter> parameters;
  /// Throws InputError where the inputs contradict each other.
  std::shared_ptr<const Bsdf> (*make)(const BsdfInputs& inputs);
  /// The material's reflectance is a factor on what the model reflects by itself: 1 changes nothing.
  bool reflectance_is_factor = false;

  /// Whether its name alone does not say all: a parameter has to be given.
  bool needs_parameters() const { return first_needed() != nullptr; }
  /// The first parameter that has to be given; null where there is none.
  const BsdfParameter* first_needed() const;
};

/// All models, in the order in which they are listed. A new one is a pair of files beside these, and a row in
/// materials/bsdf_models.cpp.
std::span<const BsdfModel* const> bsdf_models();
/// Throws InputError, with the choices, where there is none of that key.
const BsdfModel& bsdf_model(std::string_view key);

}  // namespace ifov::materials
