#pragma once

#include "ifov/temperature.h"
#include "io/temperature_report/temperature_report.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

struct DocumentOutdoors;

/// What surface temperatures are solved under. InputError where the document has no time or no weather.
DocumentOutdoors outdoors_of_survey(const io::Document& document);

/// Answers without reading the scene's geometry. Errors as of ifov::survey_temperatures.
io::TemperatureReport survey_temperatures(const io::Document& document, const TemperatureQuestion& question);

/// Of a point of the scene, solved in full by itself. Errors as of ifov::point_temperature.
io::TemperatureReport point_temperature(const io::Document& document, const PointQuestion& question);

}  // namespace ifov::session
