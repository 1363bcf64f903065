#pragma once

#include <string_view>

namespace ifov::thermal {

/// Classes of terrain by what stops the wind, with the roughness length of Davenport's classification as Wieringa (1992),
/// J. Wind Eng. Ind. Aerodyn. 41-44, 357, has it.
enum class Terrain {
  sea,     ///< 0.0002 m: open water, five kilometres and more
  smooth,  ///< 0.005 m: beaches, pack ice, desert without plants
  open,    ///< 0.03 m: low grass, an airfield
  rough,   ///< 0.25 m: high crops, scattered obstacles
  suburb,  ///< 1 m: suburb, forest
};
inline constexpr int kTerrains = 5;
std::string_view name_of(Terrain terrain);  ///< "sea"
double roughness_length_m(Terrain terrain);

/// Where and over what the wind was measured: 10 m over open terrain, as the World Meteorological Organization asks.
struct Anemometer {
  double height_m = 10.0;
  Terrain terrain = Terrain::open;
};

/// Nothing is lower: correlations of convection want the wind that blows over a surface, and at the ground itself there is none.
inline constexpr double kLowestWind_m = 2.0;

/// What all terrains share the wind at.
inline constexpr double kBlending_m = 60.0;
/// ln(z / z0), of heights that the law holds for.
double log_height(double height_m, double roughness_m);

/// The wind at a height over terrain by the logarithmic law u = (u* / 0.4) ln(z / z0) of neutral air, from one measured
/// over other terrain by what both have at 60 m (Wieringa 1986, Q. J. R. Meteorol. Soc. 112, 867: the blending height).
/// Heights count from kLowestWind_m and twice the roughness length on.
double wind_at_m_s(double measured_m_s, const Anemometer& anemometer, double height_m, Terrain terrain);

}  // namespace ifov::thermal
