#pragma once

#include <optional>

#include "geodesy/geodetic.h"
#include "io/series_report/series_report.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// Where a document's scene stands: its own place, else that of its weather; nothing where neither tells.
std::optional<geodesy::Geodetic> place_of_series(const io::Document& document);

/// Names the crossovers by the Sun: "dawn" and "dusk" where it stands 18 degrees below the horizon to 30 above it, before or after
/// noon; else "morning", "afternoon", "night". And tells when the Sun is down.
void tell_of_sun(const geodesy::Geodetic& place, io::SeriesReport& report);

}  // namespace ifov::session
