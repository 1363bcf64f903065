#pragma once

#include <cstdint>
#include <string>

#include "io/document/scene_document.h"
#include "studies/common/exact_area.h"
#include "studies/common/texture_map.h"

namespace ifov::io {
struct Document;
struct ErrorSize;
struct SamplingDocument;
}  // namespace ifov::io

namespace ifov::studies {

/// Study 2: black surfaces at 40 C on black ground at 20 C, 3 x 3 pixels of 1 m, one wavelength of 8.5 um.
inline constexpr double kThermalWavelength_um = 8.5;
inline constexpr double kHot_k = 313.15, kCold_k = 293.15;

double hot_radiance();  ///< W m-2 sr-1 um-1
double cold_radiance();

/// The paper's linear conversion: an error in radiance over the slope of Planck's law at the half-and-half
/// mix.
double error_c(double radiance_error);
/// The radiance of an error in degrees, to nine digits.
io::ErrorSize radiance_of_error(double error_c);

/// A scene and what the centre pixel must show.
struct ThermalScene {
  io::SceneDocument scene;
  double west_m = -1.5, north_m = 1.5;  ///< of the image
  double truth = 0.0;                   ///< radiance of the centre pixel
  double hot_fraction = 0.0;            ///< of the centre pixel

  io::Document document(io::SamplingDocument sampling, std::uint64_t seed) const;
};

/// A hemisphere; positions in the image frame of the 3 x 3 pixels.
ThermalScene dome_scene(const Disc& disc);
/// A flat disk 1 cm above the ground.
ThermalScene disk_scene(const Disc& disc);
/// A box 5 mm high.
ThermalScene box_scene(double x_px, double y_px, double length_px, double width_px, double angle_rad);
/// A dome with the texture on both surfaces, somewhere on a large map; `map_x_m`, `map_y_m` of the image's
/// corner.
ThermalScene textured_dome_scene(const Disc& disc, const TextureMap& texture, double map_x_m, double map_y_m);

/// The families over which shifts are drawn: position, and where it applies size and angle, from (seed,
/// trial).
enum class Family { dome, square, rod, small_target, large_target, textured_dome };
ThermalScene random_scene(Family family, std::uint64_t seed, int trial, const TextureMap& texture);

/// The paper's dome: half of the centre pixel, in its middle.
Disc paper_dome();

}  // namespace ifov::studies
