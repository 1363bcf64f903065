#pragma once

#include <string>
#include <vector>

#include "session/plausibility/scene_survey.h"

namespace ifov::session {

/// Where the scene, the camera and the Sun are, what of the scene is in the picture, what lights it and what some
/// thousand rays see: lines of two columns for people. Map coordinates where the scene's origin has some.
std::vector<std::string> location_lines(const Parts& parts, const SceneSurvey& survey);

/// "x -20 to 20 m, y -15 to 15 m", on the map "east 440012 to 440052 m, north ... (map)".
std::string area_text(const Parts& parts, SceneSurvey::Range x_m, SceneSurvey::Range y_m);

}  // namespace ifov::session
