#pragma once

#include <string>

#include "io/temperature_report/temperature_report.h"

namespace ifov::thermal {
struct SurfaceSolution;
}

namespace ifov::session {

struct DocumentOutdoors;

/// The last 24 hours of what surfaces are solved under, with what stood in for what the weather does not tell; of no surface yet. `document`:
/// its name.
io::TemperatureReport report_about(const std::string& document, const DocumentOutdoors& about);

/// What a solution says of them.
io::TemperatureReport::Day day_of(const thermal::SurfaceSolution& solution, const DocumentOutdoors& about);

/// What came in over all the time and neither left nor was stored, over what came in.
double unaccounted_of(const thermal::SurfaceSolution& solution);

}  // namespace ifov::session
