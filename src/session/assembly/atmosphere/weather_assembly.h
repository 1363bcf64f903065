#pragma once

#include <optional>
#include <string>

#include "atmosphere/weather_series.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// The document's weather, read and checked; none where it has none. Throws InputError, at the place in the
/// document, also where a file has nothing to say about the document's time.
std::optional<atmosphere::WeatherSeries> assemble_weather(const io::Document& document);

/// One line for people: the air at the document's time.
std::string weather_statement(const io::Document& document, const atmosphere::WeatherSeries& weather);

}  // namespace ifov::session
