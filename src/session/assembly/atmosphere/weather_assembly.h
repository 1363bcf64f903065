#pragma once

#include <memory>
#include <optional>
#include <string>

#include "geodesy/utc_time.h"

namespace ifov::atmosphere {
class WeatherSeries;
}
namespace ifov::io {
struct DocumentSources;
struct WeatherDocument;
}  // namespace ifov::io

namespace ifov::session {

/// A document's weather, read and checked. Throws InputError, at the place in the document, also where a file has
/// nothing to say about the document's time.
std::shared_ptr<const atmosphere::WeatherSeries> assemble_weather(
    const io::DocumentSources& sources, const io::WeatherDocument& weather,
    const std::optional<geodesy::UtcTime>& time);

/// One line for people: the air at the document's time.
std::string weather_statement(const std::optional<geodesy::UtcTime>& document_time,
                              const atmosphere::WeatherSeries& weather);

}  // namespace ifov::session
