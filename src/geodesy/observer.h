#pragma once

#include "geodesy/utc_time.h"
#include "math/vec3.h"

namespace ifov::geodesy {

/// A place on Earth at an instant, from which celestial bodies are seen.
class Observer {
 public:
  /// `latitude_rad` and `longitude_rad` (east positive) are geodetic on WGS 84, `height_m` above the
  /// ellipsoid. `body` is what messages say cannot be placed. Throws InputError for latitudes beyond the
  /// poles or years that ERFA refuses.
  Observer(UtcTime time, double latitude_rad, double longitude_rad, double height_m, double ut1_minus_utc_s,
           const char* body);

  double tt1() const { return tt1_; }  ///< terrestrial time as a two-part Julian date
  double tt2() const { return tt2_; }

  /// From the place to a body, east-north-up, au; the body as seen from the Earth's centre in the celestial
  /// frame (GCRS), au.
  math::Vec3 enu_au(math::Vec3 body_gcrs_au) const;

 private:
  double tt1_ = 0.0, tt2_ = 0.0;
  double itrs_from_gcrs_[3][3] = {};
  math::Vec3 place_au_;
  math::Vec3 east_, north_, up_;
};

/// Azimuth clockwise from north in [0, 2 pi) and elevation of an east-north-up vector of any length.
struct Horizontal {
  double azimuth_rad = 0.0, elevation_rad = 0.0;
};
Horizontal horizontal(math::Vec3 enu);

/// The Sun and the Moon as seen from the Earth's centre (GCRS, au) at a terrestrial time, with light time,
/// and aberration where it shows: the Moon moves with the Earth about the Sun.
math::Vec3 apparent_sun_au(double tt1, double tt2);
math::Vec3 apparent_moon_au(double tt1, double tt2);

}  // namespace ifov::geodesy
