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

/// The wind at a height over terrain by the logarithmic law u = (u* / 0.4) ln(z / z0) of neutral air, from one measured
/// over other terrain by what both have at 60 m (Wieringa 1986, Q. J. R. Meteorol. Soc. 112, 867: the blending height).
/// Heights count from kLowestWind_m and twice the roughness length on.
double wind_at_m_s(double measured_m_s, const Anemometer& anemometer, double height_m, Terrain terrain);

/// Heights over a terrain, from the lowest wind up to 60 m, each with the same ratio of wind speed to the one below, at most
/// kMostRatio. Level 0 is all that is as low as the lowest wind or lower.
class WindLevels {
 public:
  static constexpr double kMostRatio = 1.2;

  explicit WindLevels(Terrain terrain);
  int highest() const { return highest_; }  ///< of the levels' numbers: that at 60 m
  double height_m(int level) const;
  /// Between levels by the logarithm of the wind: 2.5 is midway from level 2 to 3.
  double place(double height_m) const;

 private:
  double roughness_m_, lowest_ln_, ln_ratio_;  ///< ln(z / z0) of level 0; of the wind from one to the next
  int highest_;
};

}  // namespace ifov::thermal
