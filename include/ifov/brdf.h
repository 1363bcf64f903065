#pragma once

#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "ifov/document.h"

namespace ifov {

/// A model of how surfaces scatter light, as documents name it under "scattering".
struct ScatteringModel {
  struct Parameter {
    std::string key, doc;
    std::string value;         ///< what it may be, in words: "angle between 0 and 60 deg"
    std::string default_json;  ///< empty: none
    bool required = false;
  };
  std::string key, doc;
  std::string
      usual_reflectance;  ///< "1" where it is a factor on what the model reflects by itself, else "0.3"
  std::vector<Parameter> parameters;
};

IFOV_API std::vector<ScatteringModel> scattering_models();

/// What is asked about the scattering of a surface.
struct BrdfQuestion {
  /// None: only where nothing depends on it.
  std::optional<double> wavelength_um = {};
  /// From where light comes to the lobes, from the normal, 0 to less than pi / 2.
  std::vector<double> light_rad = {0.0, std::numbers::pi / 6.0, std::numbers::pi / 3.0};
  int curve = 1;        ///< of a material with several reflectances, counted from 1
  bool figure = false;  ///< work out what figure() draws beside the rest
};

/// How a surface scatters light at one wavelength. Views have a zenith angle above 0 where they are on the side of the
/// light.
class IFOV_API BrdfReport {
 public:
  /// BRDF of light from one zenith angle, in the plane of the normal and the light.
  struct Lobe {
    double light_rad = 0.0;
    std::vector<double> brdf;  ///< 1/sr, towards each of view_rad
  };
  /// Directional-hemispherical reflectance and transmittance of light from an angle, and emissivity towards there: 1 less
  /// both (Kirchhoff).
  struct Shares {
    std::vector<double> reflectance, transmittance, emissivity;  ///< no transmittance: opaque
  };
  struct Spectrum : Shares {  ///< at each of spectrum_um
    double zenith_rad = 0.0;
  };
  std::string name, model;               ///< of the material; of its scattering, as documents name it
  std::vector<std::string> description;  ///< parameters and what is to be known, a line each
  std::optional<double> wavelength_um;
  bool is_delta = false;         ///< all light leaves in one direction: there is no BRDF, and no lobe
  std::vector<double> view_rad;  ///< rising, -pi / 2 to pi / 2
  std::vector<Lobe> lobes;
  std::vector<double> zenith_rad;
  Shares by_angle;                  ///< at each of zenith_rad
  std::vector<double> spectrum_um;  ///< empty where nothing depends on wavelength
  std::vector<Spectrum> spectra;

  // What `ifov brdf` prints, writes and draws.

  /// Tables for a terminal: at most 110 columns.
  std::string table() const;
  /// All numbers, described in its comments.
  std::string csv() const;
  /// PNG. Asked for by the question. Throws SystemError where it cannot be drawn.
  std::string figure() const;

 private:
  struct Inside;
  std::shared_ptr<const Inside> inside_;
  friend struct FacadeAccess;
};

/// Of a material of a document: no other file than those of its spectra is read. Throws InputError, with the choices, where
/// there is no such material, or curve of it; where a wavelength is outside its spectra, or is missing; where its
/// parameters belong to no surface.
IFOV_API BrdfReport survey_brdf(const Document& document, const std::string& material,
                                const BrdfQuestion& question = {});

/// Of a model by itself. `set`: its parameters as documents write them, "slope=25 deg"; `reflectance`: likewise, a number
/// or a spectrum in JSON; empty: the model's usual one. Where it depends on wavelength and the question names none, at 0.55 um. Throws InputError as above, and as documents do for what they write.
IFOV_API BrdfReport survey_model(const std::string& model, const std::vector<std::string>& set,
                                 const std::string& reflectance = {}, const BrdfQuestion& question = {});

/// One line for each model and for each of its parameters.
IFOV_API std::string scattering_models_list();
/// The same as tables in Markdown.
IFOV_API std::string scattering_models_reference();

/// Micrometres of a wavelength as documents write it: "0.55 um", "550 nm". Throws InputError, which quotes it, where it is
/// none.
IFOV_API double wavelength_um_of(const std::string& text);

}  // namespace ifov
