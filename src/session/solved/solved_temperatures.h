#pragma once

#include <optional>

#include "core/error.h"
#include "core/run_control.h"
#include "session/loaded/temperature_errors.h"
#include "session/solved/solved_classes.h"

namespace ifov::atmosphere {
class WeatherSeries;
}
namespace ifov::io {
struct Document;
}
namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::session {

struct Parts;

/// Where the document first asks for a temperature that is solved; nothing where it asks for none.
std::optional<SourcePosition> solved_temperature_at(const io::Document& document);

/// Nothing where temperatures that are solved have the weather that they need, or none are. Else InputError, located.
void require_weather(const io::Document& document);

/// Solves for the temperature of every material whose document asks for it (`"temperature": "solved"`) under its weather,
/// and gives it to the scene; then measures what that may be off by at points that the camera sees, and at some that it does not (`unseen`, and
/// where something may show them). Nothing where nobody asks. InputError, located: what is missing (a time, weather, a place, what a
/// material stands on). `weather` may be null. `shared`, which may be null, has what sessions of the same scene, time and weather have
/// solved, and gets what it lacks.
std::optional<TemperatureErrors> solve_temperatures(const io::Document& document,
                                                    const atmosphere::WeatherSeries* weather,
                                                    const sensor::Camera& camera, scene::Scene& scene,
                                                    bool unseen, SolvedClasses* shared, int threads,
                                                    LogSink* log);

/// Whether some material is not Lambertian: a mirror or a pane may show what the camera does not see.
bool may_show_unseen(const scene::Scene& scene);

/// Puts what solved temperatures may be off by into the half-widths of the channels. InputError where an accuracy in kelvins is
/// asked for that is finer than that; a warning where one in per cent is.
void count_temperature_errors(Parts& parts, LogSink& log);

}  // namespace ifov::session
