#pragma once

#include <optional>
#include <string>
#include <vector>

#include "atmosphere/sensor/sensor_geometry.h"
#include "atmosphere/survey/atmosphere_effects.h"
#include "atmosphere/survey/neutral_points.h"
#include "atmosphere/survey/sky_view.h"

namespace ifov::io {

/// What there is to tell of a document's atmosphere.
struct AtmosphereReport {
  struct Channel {
    std::string name;
    double first_um = 0.0, last_um = 0.0;  ///< where the response is above half of its maximum
    atmosphere::AtmosphereEffects light;
  };
  std::vector<std::string> description;  ///< air, aerosol and geometry, a line each
  atmosphere::SensorGeometry geometry;
  std::optional<double> sun_azimuth_rad;  ///< clockwise from north
  std::string body = "Sun";               ///< what shines: Sun or Moon
  std::vector<Channel> channels;
  std::vector<atmosphere::AtmosphereEffects>
      spectrum;                             ///< from short to long wavelengths; empty if not asked for
  double step_cm1 = 0.0;                    ///< of the spectrum
  std::string ground = "of reflectance 0";  ///< what is told over ground that reflects, after "ground"
  std::optional<atmosphere::SkyView> sky;
  std::string sky_channel;
  bool sky_is_thermal = false;  ///< emission outweighs sunlight: shown as brightness temperature
  std::vector<atmosphere::NeutralPoint> neutral_points;  ///< of that sky
};

/// The table of channels, for a terminal: at most 110 columns.
std::string atmosphere_report_text(const AtmosphereReport& report);

/// The spectrum as a table of paths (docs/formats/atmosphere_import.md), described in its comments.
std::string atmosphere_report_csv(const AtmosphereReport& report);

/// The sky by direction, with its polarization, described in its comments. The report has a sky.
std::string sky_csv(const AtmosphereReport& report);

/// Transmittance, path radiance and irradiance over wavelength, and the sky above, as PNG. The report has a
/// spectrum and a sky. Throws SystemError where it cannot be drawn.
std::string atmosphere_report_figure(const AtmosphereReport& report);

}  // namespace ifov::io
