#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "io/document/spectrum_document.h"
#include "math/vec3.h"

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

/// What rays meet that leave the scene below the horizon: level ground lit by the Sun and sky alone.
struct SurroundingsDocument {
  bool is_emissivity = false;
  SpectrumDocument spectrum;             ///< of Lambertian ground
  std::optional<DocumentName> material;  ///< in place of the spectrum: one of the document's
  std::optional<double> temperature_k;   ///< absent: that of the material; without one it emits nothing
  SourcePosition position;
};

/// A lamp: a body that gives off light and reflects none. All but disks are spheres.
struct LampDocument {
  enum class Form {
    point,       ///< the same in all directions: a small sphere
    sphere,      ///< the same in all directions
    spot,        ///< a cone of light
    disk,        ///< one side of a flat disk, by Lambert's law
    goniometer,  ///< intensities from a file of IES LM-63
  };
  Form form = Form::point;
  math::Point3 at_m;
  double radius_m = 0.01;
  math::Vec3 towards{0.0, 0.0, -1.0};  ///< any length above zero
  double half_angle_rad = 0.0, edge_rad = 0.0;
  std::optional<DocumentFile> intensities;
  double azimuth_rad = 0.0;  ///< of the file's plane of 0 deg, clockwise from north
  /// One of these, or none beside a file, whose light is then grey.
  std::optional<double> temperature_k;
  std::optional<SpectrumDocument> spectrum, radiance;  ///< any unit; W m-2 sr-1 um-1
  /// At most one; without them the temperature, the radiance or the file's own intensities say how much there is.
  std::optional<double> power_w, flux_lm;
  SourcePosition position;
};

struct LightDocument {
  std::vector<LampDocument> lamps;
  std::optional<SunDocument> sun;
  std::optional<MoonDocument> moon;
  std::variant<NoSky, SkyTemperature, SkyRadiance> sky;
  SourcePosition sky_position;
  /// Absent: the mean of the ground in the picture under a modelled or imported atmosphere, else black and at 0 K.
  std::optional<SurroundingsDocument> surroundings;
  SourcePosition position;
};

}  // namespace ifov::io
