#pragma once

#include <optional>
#include <string>

#include "core/run_control.h"
#include "io/air/air_report.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// What is asked about a document's atmosphere, and what is to be otherwise than the document says.
struct AtmosphereQuestion {
  struct Direction {
    double zenith_rad = 0.0, azimuth_rad = 0.0;  ///< from the ground towards it; azimuth clockwise from north
  };
  std::optional<Direction> sun, view;
  bool night = false;  ///< no Sun
  std::optional<double> sensor_altitude_km;
  bool spectrum = false;    ///< at the band model's resolution over the range of the sensor
  bool sky = false;         ///< the whole sky in one channel
  std::string sky_channel;  ///< empty: the one next to 0.45 um by day, to 10 um without a Sun
  int threads = 0;
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;
  LogSink* log = nullptr;
};

/// Answers without reading the scene's meshes and maps. Throws InputError where the document has no modelled
/// atmosphere, or names no such channel, and what Session::load does for atmosphere, light and sensor.
io::AirReport survey_atmosphere(const io::Document& document, const AtmosphereQuestion& question);

}  // namespace ifov::session
