#include "io/quantities/classes.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "io/envi/envi_header.h"

namespace ifov::io {
void add_classes(std::span<const std::string> names, std::span<const Rgb> colours, EnviHeader& header) {
  std::string named, looked_up;
  for (const std::string& name : names) named += (named.empty() ? "" : ", ") + list_item(name);
  for (const Rgb c : colours)
    looked_up += format("{}{}, {}, {}", looked_up.empty() ? "" : ", ", c.r, c.g, c.b);
  header.is_classification = true;
  header.other["classes"] = format("{}", names.size());
  header.other["class names"] = named;
  header.other["class lookup"] = looked_up;
}

std::vector<Rgb> distinct_colours(std::size_t count) {
  constexpr double kGoldenTurn = 0.6180339887498949, kChroma[3] = {0.75, 0.5, 0.65},
                   kLight[3] = {0.55, 0.75, 0.4};
  std::vector<Rgb> colours(count);
  for (std::size_t k = 1; k < count; ++k) {
    const double hue = 6.0 * std::fmod(static_cast<double>(k) * kGoldenTurn, 1.0);
    const double light = kLight[k % 3], spread = kChroma[k % 3] * std::min(light, 1.0 - light);
    // Of a hue in six parts: each primary rises, stays, falls and is gone, a third of the circle apart.
    const auto primary = [&](double from) {
      const double at = std::fmod(hue + from, 6.0);
      const double part = std::clamp(std::abs(at - 3.0) - 1.0, 0.0, 1.0);
      return static_cast<std::uint8_t>(std::lround(255.0 * (light + spread * (2.0 * part - 1.0))));
    };
    colours[k] = {primary(0.0), primary(4.0), primary(2.0)};
  }
  return colours;
}

}  // namespace ifov::io
