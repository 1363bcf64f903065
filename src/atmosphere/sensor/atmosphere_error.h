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

/// What the model's own error makes of a channel (docs/theory/atmosphere_model_error.md): what is true may lie anywhere
/// between what was computed and what less (or as much more) absorption shows. Radiances in W m-2 sr-1 um-1.
struct ChannelModelError {
  double surface = 0.0;   ///< of light from surfaces on its way to the sensor, relative
  double sunlight = 0.0;  ///< of reflected sunlight on its way down, relative
  double scattered = 0.0,
         scattered_floor = 0.0;  ///< of sunlight scattered into the path, relative, and beside that
  double by_shape =
      0.0;  ///< likewise, of paths alone: particles taken for spheres; the sky's flux hardly knows
  double by_clouds = 0.0,
         sky_by_clouds =
             0.0;         ///< likewise, of paths and of skylight: what droplets and crystals are taken for
  bool of_bands = false;  ///< a table of terms in place of bands does not say what its depths may be off by
  double emission = 0.0, emission_less = 0.0;   ///< what the path emits; its change with less absorption
  double emission_other = 0.0;                  ///< how far it may be off beside that
  double sky_emission = 0.0, sky_change = 0.0;  ///< mean over a level surface's view; how far that may be off
};

/// The same by where it comes from (docs/theory/atmosphere_error.md).
struct AtmosphereErrors {
  AtmosphereError absorption;  ///< few absorption terms, layers of finite thickness
  AtmosphereError scattering;  ///< interpolation between few solutions, and their angles, layers and orders
  AtmosphereError nodes;       ///< few spectral nodes
  AtmosphereError sky;         ///< linear between the directions of the sky's table
  AtmosphereError lines_of_sight;  ///< between the lines of sight of the path's table

  ChannelModelError model = {};  ///< not in total(), which is of the numbers

  AtmosphereError total() const {
    AtmosphereError sum = absorption;
    return (((sum += scattering) += nodes) += sky) += lines_of_sight;
  }
};

}  // namespace ifov::atmosphere
