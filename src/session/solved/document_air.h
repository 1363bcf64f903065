#pragma once

#include "thermal/air_of_document.h"

namespace ifov::atmosphere {
class WeatherSeries;
}
namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// What the atmosphere that a document has modelled stands in with for what its weather does not tell: long-wave of the sky. Its
/// clouds are left out where the weather tells of cloud. Nothing where it is told or no atmosphere is modelled.
thermal::AirOfDocument air_of_document(const io::Document& document,
                                       const atmosphere::WeatherSeries& weather);

}  // namespace ifov::session
