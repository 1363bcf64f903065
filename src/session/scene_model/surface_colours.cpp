#include "session/scene_model/surface_colours.h"

#include <algorithm>
#include <cmath>

namespace ifov::session {

using radiometry::LinearRgb;

LinearRgb visible_colour(const materials::Material& material, std::size_t number) {
  constexpr double kBlue_um = 0.47, kRed_um = 0.63;
  const radiometry::Spectrum& reflectance = material.reflectance;
  if (reflectance.first_um() > kBlue_um || reflectance.last_um() < kRed_um) return distinct_colour(number);
  LinearRgb colour = radiometry::linear_srgb_of(reflectance.with_outside(radiometry::OutsideRange::extend));
  for (double& value : colour) value = std::clamp(value, 0.0, 1.0);
  return colour;
}

LinearRgb distinct_colour(std::size_t number) {
  constexpr double kGoldenAngle = 137.50776405003785;
  const double hue = std::fmod(static_cast<double>(number) * kGoldenAngle, 360.0);
  const double light = 0.48 + 0.09 * static_cast<double>(number % 3),
               spread = 0.6 * std::min(light, 1.0 - light);
  // From hue, saturation and lightness (CSS Color 4, 7.1).
  LinearRgb colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    constexpr double kBegin[] = {0.0, 8.0, 4.0};
    const double t = std::fmod(kBegin[c] + hue / 30.0, 12.0);
    colour[c] = radiometry::srgb_decoded(light - spread * std::max(-1.0, std::min({t - 3.0, 9.0 - t, 1.0})));
  }
  return colour;
}

}  // namespace ifov::session
