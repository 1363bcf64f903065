#include "io/envi/colour_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace ifov::io {
namespace {

struct Lab {
  double l, a, b;
};

std::array<double, 3> linear_rgb(const Lab& c) {
  const double l = std::pow(c.l + 0.3963377774 * c.a + 0.2158037573 * c.b, 3);
  const double m = std::pow(c.l - 0.1055613458 * c.a - 0.0638541728 * c.b, 3);
  const double s = std::pow(c.l - 0.0894841775 * c.a - 1.2914855480 * c.b, 3);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool in_gamut(const Lab& c) {
  const auto rgb = linear_rgb(c);
  return std::all_of(rgb.begin(), rgb.end(), [](double v) { return v >= 0.0 && v <= 1.0; });
}

struct Path {
  double dark, light;  // lightness at the ends
  double first_hue_deg, last_hue_deg;
  double chroma;  // asked for; less where the screen cannot show it
};

Lab on_path(const Path& path, double t) {
  const double lightness = path.dark + (path.light - path.dark) * t;
  const double hue =
      (path.first_hue_deg + (path.last_hue_deg - path.first_hue_deg) * t) * std::numbers::pi / 180.0;
  double low = 0.0, high = path.chroma;
  const auto colour = [&](double chroma) {
    return Lab{lightness, chroma * std::cos(hue), chroma * std::sin(hue)};
  };
  if (in_gamut(colour(high))) return colour(high);
  for (int i = 0; i < 40; ++i) (in_gamut(colour((low + high) / 2)) ? low : high) = (low + high) / 2;
  return colour(low);
}

ColourMap make(const Path& path) {
  constexpr int kFine = 4096;
  std::vector<Lab> colours;
  std::vector<double> distance{0.0};
  for (int i = 0; i <= kFine; ++i) {
    colours.push_back(on_path(path, static_cast<double>(i) / kFine));
    if (i == 0) continue;
    const Lab &p = colours[colours.size() - 2], &q = colours.back();
    distance.push_back(distance.back() + std::hypot(q.l - p.l, q.a - p.a, q.b - p.b));
  }
  ColourMap map;
  for (std::size_t k = 0; k < map.size(); ++k) {
    const double wanted = distance.back() * static_cast<double>(k) / static_cast<double>(map.size() - 1);
    const auto index = std::lower_bound(distance.begin(), distance.end(), wanted) - distance.begin();
    const auto rgb = linear_rgb(colours[std::min<std::size_t>(static_cast<std::size_t>(index), kFine)]);
    map[k] = {srgb_code(rgb[0]), srgb_code(rgb[1]), srgb_code(rgb[2])};
  }
  return map;
}

}  // namespace

std::uint8_t srgb_code(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  const double coded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;  // IEC 61966-2-1
  return static_cast<std::uint8_t>(std::lround(255.0 * coded));
}

const ColourMap& sequential_colours() {
  static const ColourMap map = make({0.22, 0.93, 285.0, 100.0, 0.125});
  return map;
}

const ColourMap& heat_colours() {
  static const ColourMap map = make({0.20, 0.94, 290.0, 460.0, 0.16});
  return map;
}

}  // namespace ifov::io
