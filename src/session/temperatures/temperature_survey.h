#pragma once

#include "ifov/temperature.h"
#include "io/temperature_report/temperature_report.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// Answers without reading the scene's geometry. Errors as of ifov::survey_temperatures.
io::TemperatureReport survey_temperatures(const io::Document& document, const TemperatureQuestion& question);

}  // namespace ifov::session
