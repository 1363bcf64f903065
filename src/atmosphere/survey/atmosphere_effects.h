#pragma once

namespace ifov::atmosphere {

/// What the air does to the light of one channel, for people to look at: means over the response. Radiances
/// in W m-2 sr-1 um-1, irradiances in W m-2 um-1 on a level surface, both over black ground. Without a Sun,
/// what is sunlight is 0.
struct AtmosphereEffects {
  double wavelength_um = 0.0;
  double solar_irradiance = 0.0;       ///< above the air, across the beam
  double sun_transmittance = 0.0;      ///< of direct sunlight, down to the ground
  double view_transmittance = 0.0;     ///< direct, from the ground to the sensor
  double diffuse_transmittance = 0.0;  ///< from bright ground all around to the sensor, scattered on the way
  double solar_path = 0.0, thermal_path = 0.0;  ///< radiance that the path to the sensor adds
  double direct_irradiance = 0.0;
  double solar_sky = 0.0, thermal_sky = 0.0;  ///< irradiance of the sky
  double spherical_albedo = 0.0;  ///< of the air for light from below, 0 where it was not computed
  /// Q and U of solar_path, about the vertical plane of the line of sight: Q > 0 where light swings in it. SensorGeometry's
  /// azimuth is read as clockwise.
  double path_q = 0.0, path_u = 0.0;

  /// The same air over level, uniform ground that was asked for, which emits nothing. Irradiances of level surfaces, sunlight and
  /// emission of the air together.
  struct OverGround {
    double ground_diffuse = 0.0, ground_up = 0.0;                       ///< beside direct_irradiance
    double sensor_direct = 0.0, sensor_diffuse = 0.0, sensor_up = 0.0;  ///< at the sensor's altitude
    double radiance = 0.0, q = 0.0, u = 0.0;                            ///< that the sensor receives
  } over_ground = {};
};

}  // namespace ifov::atmosphere
