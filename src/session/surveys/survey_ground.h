#pragma once

#include <memory>
#include <string>

#include "radiometry/spectrum.h"

namespace ifov::atmosphere {
class DirectionalGround;
}
namespace ifov::io {
struct Document;
}

namespace ifov::session {

struct SurveyStage;

/// The ground that a question about an atmosphere asks for.
struct SurveyGround {
  radiometry::Spectrum reflectance;                                  ///< of a directional one bihemispherical
  std::shared_ptr<const atmosphere::DirectionalGround> directional;  ///< null: it is Lambertian
  std::string left_out;     ///< of how it reflects, a sentence; empty: nothing
  std::string description;  ///< "of reflectance 0.3", "'sea' by its BRDF"
};

/// `material`: its name, or "surroundings"; empty: `reflectance` is the ground's. Throws InputError where there is no such material,
/// or it is no ground.
SurveyGround survey_ground(const io::Document& document, const std::string& material, double reflectance,
                           const SurveyStage& stage);

}  // namespace ifov::session
