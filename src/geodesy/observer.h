#pragma once

#include "geodesy/geodetic.h"
#include "geodesy/utc_time.h"

namespace ifov::geodesy {

/// A place on Earth at an instant, from which celestial bodies are seen.
class Observer {
 public:
  /// `body` is what messages say cannot be placed. Throws InputError for latitudes beyond the poles or years that ERFA
  /// refuses.
  Observer(UtcTime time, const Geodetic& place, double ut1_minus_utc_s, const char* body);

  double tt1() const { return times_.tt1; }  ///< terrestrial time as a two-part Julian date
  double tt2() const { return times_.tt2; }

  /// From the place to a body, au; the body as seen from the Earth's centre, au.
  EnuVector to_body_au(GcrsVector body_au) const;

 private:
  struct Times {
    double tt1 = 0.0, tt2 = 0.0, ut11 = 0.0, ut12 = 0.0;
  };
  static Times times(UtcTime time, double ut1_minus_utc_s, const char* body);

  Times times_;
  FrameTransform<Ecef, Gcrs> ecef_from_gcrs_;
  FrameTransform<Ecef, Enu> ecef_from_enu_;
  EcefVector position_au_;
};

/// Azimuth clockwise from north in [0, 2 pi) and elevation of a vector of any length.
struct Horizontal {
  double azimuth_rad = 0.0, elevation_rad = 0.0;
};
Horizontal horizontal(EnuVector vector);

/// The Sun and the Moon as seen from the Earth's centre (au) at a terrestrial time, with light time,
/// and aberration where it shows: the Moon moves with the Earth about the Sun.
GcrsVector apparent_sun_au(double tt1, double tt2);
GcrsVector apparent_moon_au(double tt1, double tt2);

}  // namespace ifov::geodesy
