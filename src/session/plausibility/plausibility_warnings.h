#pragma once

#include "core/run_control.h"
#include "session/plausibility/scene_survey.h"

namespace ifov::session {

/// What is most likely not meant, with what to do: where things and the camera are.
void warn_of_locations(const Parts& parts, const SceneSurvey& survey, LogSink& log);
/// The same of numbers: temperatures, wavelengths, light, accuracies.
void warn_of_values(const Parts& parts, const SceneSurvey& survey, LogSink& log);
/// Throws InputError where nothing shines in any channel.
void require_light(const Parts& parts, const SceneSurvey& survey);

/// Reflectances that were made of colours, and the channels in which these say nothing.
void warn_of_colours(const Parts& parts, LogSink& log);

/// Things that stand in the air or lie under the ground.
void warn_of_standing(const Parts& parts, LogSink& log);

}  // namespace ifov::session
