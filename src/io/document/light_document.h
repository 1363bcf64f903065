#pragma once

#include <optional>
#include <variant>

#include "io/document/scene_document.h"
#include "io/document/spectrum_document.h"

namespace ifov::io {

/// Where the Sun or the Moon stands.
struct CelestialDirection {
  double zenith_rad = 0.0;
  double azimuth_rad = 0.0;  ///< clockwise from north (+y)
};

struct SunDocument {
  /// Absent: from the document's time and the scene's geographic origin, which are there then.
  std::optional<CelestialDirection> direction;
  double diameter_rad = 0.0;                   ///< angular diameter of the disc; 0 for a point
  std::optional<double> distance_au;           ///< absent: from the document's time, else 1
  std::optional<SpectrumDocument> irradiance;  ///< W m-2 um-1 at 1 au; absent: the built-in one
  SourcePosition position;
};

/// Lights the scene where the Sun does not: it is absent, or below the horizon.
struct MoonDocument {
  /// Absent: from the document's time and the scene's geographic origin, which are there then.
  std::optional<CelestialDirection> direction;
  std::optional<double> phase_angle_rad;  ///< absent: from the document's time, which is there then
  SourcePosition position;
};

struct NoSky {};
struct SkyTemperature {
  double temperature_k = 0.0;
};
/// Uniform over the upper hemisphere.
struct SkyRadiance {
  SpectrumDocument radiance;
};

/// What rays meet that leave the scene below the horizon: a Lambertian surface lit by the Sun and sky alone.
struct SurroundingsDocument {
  bool is_emissivity = false;
  SpectrumDocument spectrum;
  std::optional<double> temperature_k;  ///< absent: emits nothing
  SourcePosition position;
};

struct LightDocument {
  std::optional<SunDocument> sun;
  std::optional<MoonDocument> moon;
  std::variant<NoSky, SkyTemperature, SkyRadiance> sky;
  SourcePosition sky_position;
  /// Absent: the mean of the ground in the picture under a modelled or imported atmosphere, else black and at 0 K.
  std::optional<SurroundingsDocument> surroundings;
  SourcePosition position;
};

}  // namespace ifov::io
