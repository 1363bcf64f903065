#pragma once

namespace ifov::atmosphere {

/// How far the radiance of a channel may be off because of how the air is computed. What is known of the air
/// (band model, aerosol, profile) is taken as right.
struct AtmosphereError {
  double path = 0.0;     ///< of the radiance that the path adds, W m-2 sr-1 um-1
  double surface = 0.0;  ///< of light from surfaces that arrives at the sensor, relative
  double sky = 0.0;      ///< of what of that is skylight reflected by inclined or shaded surfaces, relative

  AtmosphereError& operator+=(const AtmosphereError& other) {
    path += other.path;
    surface += other.surface;
    sky += other.sky;
    return *this;
  }
};

/// The same by where it comes from (docs/theory/atmosphere_error.md).
struct AtmosphereErrors {
  AtmosphereError absorption;  ///< few absorption terms, layers of finite thickness
  AtmosphereError scattering;  ///< interpolation between few solutions, and their angles, layers and orders
  AtmosphereError nodes;       ///< few spectral nodes
  AtmosphereError sky;         ///< linear between the directions of the sky's table
  AtmosphereError lines_of_sight;  ///< between the lines of sight of the path's table

  AtmosphereError total() const {
    AtmosphereError sum = absorption;
    return (((sum += scattering) += nodes) += sky) += lines_of_sight;
  }
};

}  // namespace ifov::atmosphere
