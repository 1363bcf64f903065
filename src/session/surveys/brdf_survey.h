#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ifov/brdf.h"
#include "io/brdf_report/brdf_report.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// Answers without reading more of the scene than the material. Errors as of ifov::survey_brdf. `usual_um`: the wavelength, where
/// spectra differ and the question names none.
io::BrdfReport survey_brdf(const io::Document& document, const std::string& material,
                           const BrdfQuestion& question, std::optional<double> usual_um = {});

/// A document with one material, called as the model, of this model and reflectance. Errors as of ifov::survey_model.
io::Document document_of_model(const std::string& model, const std::vector<std::string>& set,
                               const std::string& reflectance);

}  // namespace ifov::session
