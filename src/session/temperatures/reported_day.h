#pragma once

#include <cstddef>

#include "io/temperature_report/temperature_report.h"

namespace ifov::io {
struct Document;
}
namespace ifov::thermal {
struct SurfaceSolution;
}

namespace ifov::session {

struct DocumentOutdoors;

/// What surface temperatures are solved under. InputError where the document has no time or no weather.
DocumentOutdoors outdoors_of_survey(const io::Document& document);

/// The last 24 hours of it, with what stood in for what the weather does not tell; of no surface yet.
io::TemperatureReport report_about(const io::Document& document, const DocumentOutdoors& about);

/// What a solution says of them.
io::TemperatureReport::Day day_of(const thermal::SurfaceSolution& solution, const DocumentOutdoors& about);

/// What came in over all the time and neither left nor was stored, over what came in.
double unaccounted_of(const thermal::SurfaceSolution& solution);

}  // namespace ifov::session
