#pragma once

namespace ifov::atmosphere {

/// How far the radiance of a channel may be off because of how the air is computed. What is known of the air
/// (band model, aerosol, profile) is taken as right.
struct AirError {
  double path = 0.0;     ///< of the radiance that the path adds, W m-2 sr-1 um-1
  double surface = 0.0;  ///< of light from surfaces that arrives at the sensor, relative
  double sky = 0.0;      ///< of what of that is skylight reflected by inclined or shaded surfaces, relative

  AirError& operator+=(const AirError& other) {
    path += other.path;
    surface += other.surface;
    sky += other.sky;
    return *this;
  }
};

/// The same by where it comes from (docs/theory/atmosphere_error.md).
struct AirErrors {
  AirError absorption;  ///< few absorption terms, layers of finite thickness
  AirError scattering;  ///< interpolation between few solutions, and their angles, layers and orders
  AirError nodes;       ///< few spectral nodes
  AirError sky;         ///< linear between the directions of the sky's table
  AirError sights;      ///< between the lines of sight of the path's table

  AirError total() const {
    AirError sum = absorption;
    return (((sum += scattering) += nodes) += sky) += sights;
  }
};

}  // namespace ifov::atmosphere
