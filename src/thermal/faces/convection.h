#pragma once

#include <string_view>

namespace ifov::thermal {

/// How rough a surface is to the wind, with the factor on forced convection over that of glass: Walton (1983), TARP
/// reference manual, NBSIR 83-2655, of ASHRAE's classes.
enum class Roughness {
  very_rough,     ///< 2.17: stucco, shingle, vegetation
  rough,          ///< 1.67: brick, soil
  medium_rough,   ///< 1.52: concrete
  medium_smooth,  ///< 1.13: clear pine
  smooth,         ///< 1.11: plaster, metal
  very_smooth,    ///< 1.00: glass, gloss paint
};
inline constexpr int kRoughnesses = 6;
std::string_view name_of(Roughness roughness);  ///< "very rough"
double roughness_factor(Roughness roughness);

/// A coefficient, W m-2 K-1, and its derivative by the surface's temperature, W m-2 K-2.
struct Coefficient {
  double h_w_m2_k = 0.0;
  double slope_w_m2_k2 = 0.0;
};

/// Free convection at a plate whose normal has this cosine to the vertical (1: faces up), the surface warmer than the air
/// by `warmer_k`. Walton (1983): 9.482 |dT|^(1/3) / (7.238 - |cos|) where the air beside is unstable, 1.810 |dT|^(1/3) /
/// (1.382 + |cos|) where it is stable, so that a wall has ASHRAE's 1.31, a roof 1.52 and 0.76.
Coefficient natural_convection(double warmer_k, double cos_tilt);

/// Forced convection at glass, a V^b: Yazdanian and Klems (1994), ASHRAE Transactions 100(1), 1087, of walls of the mobile
/// window thermal test facility (MoWiTT): 3.26 V^0.89 to windward, 3.55 V^0.617 to leeward; V in m/s at the surface's height.
/// `windward`: 1, to leeward 0, and between for a mean over both.
double forced_convection(double wind_m_s, double windward);

/// Both, as in DOE-2: h = h_n + R (sqrt(h_n^2 + h_f^2) - h_n) with the roughness factor R.
Coefficient convection(double warmer_k, double cos_tilt, double forced_w_m2_k, Roughness roughness);

/// Whether the wind blows against a surface: all that lies flatter than 8 degrees, and walls that it meets at up to 100
/// degrees from their normal (Walton 1983). Azimuths clockwise from north; the wind's is where it comes from.
bool faces_wind(double tilt_rad, double azimuth_rad, double wind_from_rad);
/// By how much the direction of the wind fluctuates within the hour that a weather record is of, standard deviation: 15 degrees,
/// the middle of Pasquill's class C. F, still nights, is below 3.8, D, neutral air, 7.5 to 12.5, A, sunlit calms, above 22.5:
/// EPA-454/R-99-005 (2000), table 6-8.
inline constexpr double kWindSpread_rad = 0.2617993877991494;
/// The same as a share of time: of a wind whose directions are distributed normally about the recorded one, and of all
/// directions where that is not known (not a number).
double windward_share(double tilt_rad, double azimuth_rad, double wind_from_rad,
                      double spread_rad = kWindSpread_rad);

}  // namespace ifov::thermal
