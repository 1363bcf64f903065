#include "thermal/wind_profile.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ifov::thermal {
namespace {

struct TerrainRow {
  std::string_view name;
  double roughness_m;
};
constexpr std::array<TerrainRow, kTerrains> kTerrainRows{
    {{"sea", 0.0002}, {"smooth", 0.005}, {"open", 0.03}, {"rough", 0.25}, {"suburb", 1.0}}};

}  // namespace

double log_height(double height_m, double roughness_m) {
  return std::log(std::max({height_m, kLowestWind_m, 2.0 * roughness_m}) / roughness_m);
}

std::string_view name_of(Terrain terrain) { return kTerrainRows[static_cast<std::size_t>(terrain)].name; }

double roughness_length_m(Terrain terrain) {
  return kTerrainRows[static_cast<std::size_t>(terrain)].roughness_m;
}

double wind_at_m_s(double measured_m_s, const Anemometer& anemometer, double height_m, Terrain terrain) {
  const double there = roughness_length_m(anemometer.terrain), here = roughness_length_m(terrain);
  const double above = measured_m_s * log_height(kBlending_m, there) / log_height(anemometer.height_m, there);
  return above * log_height(std::min(height_m, kBlending_m), here) / log_height(kBlending_m, here);
}

}  // namespace ifov::thermal
