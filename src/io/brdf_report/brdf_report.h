#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ifov::io {

/// How a surface scatters light at one wavelength. Angles in radians from the normal. The principal plane is that of the
/// normal and the light; views in it have a zenith angle above 0 where they are on the side of the light. Where the model
/// has a direction along the surface, the light is in the azimuth of the tangent, and shares are means over azimuth.
struct BrdfReport {
  std::string name, model;               ///< of the material; the model's key
  std::vector<std::string> description;  ///< parameters and what is to be known, a line each
  std::optional<double> wavelength_um;   ///< none: the same at all
  bool is_delta = false;  ///< all light leaves in one direction: no BRDF, neither lobes nor map

  /// BRDF (1/sr) of light from one zenith angle, towards each of `view_rad`.
  struct Lobe {
    double light_rad = 0.0;
    std::vector<double> brdf;
  };
  std::vector<double> view_rad;
  std::vector<Lobe> lobes;

  /// BRDF over the hemisphere of views as a picture: its middle is the zenith, the distance from there goes with the zenith
  /// angle to pi/2 at the rim, light comes from the right and azimuth grows counterclockwise.
  struct Map {
    double light_rad = 0.0;
    int side = 0;
    std::vector<double> brdf;  ///< side x side, row by row from the top; not a number beyond the rim
  };
  std::optional<Map> map;  ///< where a figure was asked for

  /// Directional-hemispherical reflectance and transmittance of light from each of `zenith_rad`, and emissivity towards there:
  /// 1 less both (Kirchhoff).
  std::vector<double> zenith_rad, reflectance, transmittance, emissivity;  ///< no transmittance: opaque

  /// The same by wavelength at one angle.
  struct Spectrum {
    double zenith_rad = 0.0;
    std::vector<double> reflectance, transmittance, emissivity;  ///< at each of `spectrum_um`
  };
  std::vector<double> spectrum_um;  ///< empty: the same at all wavelengths
  std::vector<Spectrum> spectra;
};

/// Tables for a terminal, at most 110 columns.
std::string brdf_text(const BrdfReport& report);

/// All numbers but those of the map, a row for each, described in its comments.
std::string brdf_csv(const BrdfReport& report);

/// Lobes in the principal plane, the map over the hemisphere, reflectance and emissivity by angle and, where they differ, by
/// wavelength, as PNG. Where a map is large in range, its colours and the lobes' axis are logarithmic. Throws SystemError
/// where it cannot be drawn.
std::string brdf_figure(const BrdfReport& report);

}  // namespace ifov::io
