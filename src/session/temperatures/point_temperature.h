#pragma once

#include "ifov/temperature.h"
#include "io/temperature_report/temperature_report.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// Of a point of the scene, solved in full by itself. Errors as of ifov::point_temperature.
io::TemperatureReport point_temperature(const io::Document& document, const PointQuestion& question);

}  // namespace ifov::session
