#pragma once

#include "thermal/faces/convection.h"
#include "thermal/faces/evaporation.h"

namespace ifov::thermal {

/// A leaf's boundary layer and stomata: Campbell and Norman, An Introduction to Environmental Biophysics (1998), chapters 7 and 14.
struct Leaf {
  double width_m = 0.0;            ///< 0: it is none
  double stomatal_mol_m2_s = 0.0;  ///< conductance of one face that has them, for vapour, by day
  int stomatal_faces = 1;          ///< one, as of most trees, or both
  bool operator==(const Leaf&) const = default;
};

/// Stomata open with the light: wholly from this global irradiance on, and in the dark they are shut.
inline constexpr double kLightOfOpenStomata_w_m2 = 50.0;

/// Air along one face of a leaf, W m-2 K-1: 1.4 * 0.135 sqrt(u / d) mol m-2 s-1 by c_p = 29.3 J mol-1 K-1, with d = 0.72 of the width; 1.4 is
/// for gusts outdoors.
double leaf_forced_convection(double wind_m_s, double width_m);
/// With free convection, 0.05 (|dT| / d)^(1/4) mol m-2 s-1, half of that where the air beside a level face is stable; the two by the
/// cube root of the sum of their cubes (Churchill 1977).
Coefficient leaf_convection(double warmer_k, double cos_tilt, double forced_w_m2_k, double width_m);

/// What a leaf loses through its stomata, W m-2 of the sheet: lambda (e_s(T) - e) / p over the boundary layer of a face, which passes vapour
/// 0.147 / 0.135 times as well as heat, and stomata in series. Dew settles on both faces and passes none.
LatentHeat leaf_latent_heat(const Leaf& leaf, double surface_k, const MoistAir& air,
                            const Coefficient& of_one_face, const Coefficient& of_other);

}  // namespace ifov::thermal
