#pragma once

#include <string>

#include "geodesy/geodetic.h"
#include "thermal/outdoors_series.h"

namespace ifov::atmosphere {
class WeatherSeries;
}
namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// What a document says of the weather about its surfaces over the day before its time.
struct DocumentOutdoors {
  thermal::OutdoorsOfWeather outdoors;
  geodesy::Geodetic place;   ///< where the document stands, else where its weather was measured
  thermal::Terrain terrain;  ///< about the scene
  double mean_air_k = 0.0;   ///< over what the weather has
  std::string statement;     ///< which weather, where, and how it is stepped through
};

/// `weather` as assembled of the document, which has a time. InputError, located, where the weather does not do.
DocumentOutdoors outdoors_of_document(const io::Document& document, const atmosphere::WeatherSeries& weather);

}  // namespace ifov::session
