#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "io/document/scene_document.h"
#include "studies/common/study_options.h"

namespace ifov::io {
struct Document;
}

/// Domes of 0.4 m in pixels of 1 m, on black ground under the Sun at a zenith angle of 30 deg: nearly all of the light that a pixel sends comes
/// from a ten-thousandth of it and less.
namespace ifov::studies {

namespace domes {
inline constexpr double kRadius_m = 0.4, kIrradiance_w_m2_um = 1000.0, kSunZenith_deg = 30.0;
inline constexpr double kMetalN = 0.15, kMetalK = 3.5, kDome_um = 0.65;
}  // namespace domes

struct DomeLight {
  bool sun_is_disc = true;               ///< 0.53 deg wide; else a point
  double sky_radiance_w_m2_sr_um = 0.0;  ///< the same all over
};

/// Mirror of this reflectance.
io::MaterialDocument dome_mirror(double reflectance);
/// GGX facets of n = 0.15, k = 3.5.
io::MaterialDocument dome_metal(double roughness);

/// Radiance of a pixel that holds a whole dome of mirror, seen from straight above: rho (E R^2/4 + L pi R^2/2) over the area of the
/// pixel, the second term the sky in the inner half of the disc, whose normals are within 45 deg of the zenith.
double mirror_dome_radiance(double reflectance, const DomeLight& light);
/// The same of a dome of metal without sky: the sum over its disc of its BRDF, fine where the highlight is.
double metal_dome_radiance(double roughness);

/// across x across domes, so far from each other that none matters to the next, each off the middle of its pixel by chance; shifts
/// are those from the number `first` on.
io::Document dome_document(const io::MaterialDocument& surface, const DomeLight& light, int across, int first,
                           double error, std::uint64_t seed);

/// What the pixels of all domes say, against the truth.
struct JudgedDomes {
  int count = 0;
  int within = 0;          ///< off by 1 % at most
  int held = 0;            ///< within their half-widths
  int sure = 0;            ///< converged
  int wrong_and_sure = 0;  ///< converged, and off by more than 3 %
  double mean = 0.0;       ///< over the truth
  double worst = 0.0;      ///< largest error over the truth
  double samples = 0.0;    ///< mean number in a pixel
};
/// Renders dome_document() asking for 1 %, as many pictures of up to 4 x 4 domes as hold `shifts` of them and more: of thousands in
/// one picture highlights are looked at more coarsely.
JudgedDomes judge_domes(const io::MaterialDocument& surface, const DomeLight& light, double truth, int shifts,
                        const StudyOptions& options);

}  // namespace ifov::studies
