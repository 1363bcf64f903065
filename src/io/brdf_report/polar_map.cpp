#include "io/brdf_report/polar_map.h"

#include <cmath>
#include <numbers>

#include "core/format.h"
#include "io/figures/colour_scale.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

constexpr double kMarkSize = 12.0;

CanvasPoint place(CanvasPoint centre, double radius, double azimuth_rad) {
  return {centre.x + radius * std::cos(azimuth_rad), centre.y - radius * std::sin(azimuth_rad)};
}

void draw_angles(Canvas& canvas, CanvasPoint centre, double radius) {
  // To be seen on the dark end of the colours and on the light one.
  const Ink dark{0.0, 0.0, 0.0, 0.35}, pale{1.0, 1.0, 1.0, 0.8}, label{1.0, 1.0, 1.0, 0.7};
  for (const double zenith_deg : {30.0, 60.0}) {
    canvas.circle(centre, radius * zenith_deg / 90.0, dark, 2.0);
    canvas.circle(centre, radius * zenith_deg / 90.0, pale, 0.9);
    const CanvasPoint at = place(centre, radius * zenith_deg / 90.0, 0.35 * std::numbers::pi);
    canvas.fill_rectangle(at.x - 12.0, at.y - 7.5, 24.0, 15.0, label);
    canvas.text({at.x, at.y + 4.5}, format("{:g}\u00b0", zenith_deg), kMarkSize, Anchor::centre);
  }
  canvas.circle(centre, radius, kBlackInk, 1.0);
  for (int k = 0; k < 4; ++k) {
    const double azimuth_rad = 0.5 * k * std::numbers::pi;
    const CanvasPoint inner = place(centre, radius, azimuth_rad),
                      outer = place(centre, radius + 5.0, azimuth_rad),
                      at = place(centre, radius + (k % 2 == 0 ? 10.0 : 13.0), azimuth_rad);
    canvas.line(std::vector<CanvasPoint>{inner, outer}, kBlackInk, 1.0);
    canvas.text({at.x, at.y + 4.5}, format("{}\u00b0", 90 * k), kMarkSize,
                k == 0   ? Anchor::left
                : k == 2 ? Anchor::right
                         : Anchor::centre);
  }
}

}  // namespace

void draw_polar_map(Canvas& canvas, const BrdfReport::Map& map, const Axis& scale, CanvasPoint centre,
                    double radius) {
  const ColourMap& colours = sequential_colours();
  std::vector<Canvas::Pixel> pixels;
  pixels.reserve(map.brdf.size());
  for (const double value : map.brdf) {
    const bool is_dark = scale.logarithmic && value <= scale.first;
    pixels.push_back(
        {colour_at(colours, std::isnan(value) || is_dark ? 0.0 : scale.position(value)), !std::isnan(value)});
  }
  canvas.picture(centre.x - radius, centre.y - radius, 2.0 * radius / map.side, map.side, map.side, pixels);
  draw_angles(canvas, centre, radius);
  const CanvasPoint light = place(centre, radius * map.light_rad / (0.5 * std::numbers::pi), 0.0);
  canvas.disc(light, 5.0, {1.0, 1.0, 1.0});
  canvas.circle(light, 5.0, kBlackInk, 1.0);
  draw_colour_scale(canvas, colours, scale, centre.x + radius + 52.0, centre.y - 0.8 * radius, 1.6 * radius);
  canvas.text({centre.x + radius + 52.0, centre.y - 0.8 * radius - 12.0}, "BRDF (sr\u207b\u00b9)", 13.0);
  canvas.text({centre.x, centre.y + radius + 40.0},
              format("View zenith and azimuth; white: the light, {:g}\u00b0 from the normal",
                     map.light_rad / math::kDegree),
              kMarkSize, Anchor::centre, false, kGreyInk);
}

}  // namespace ifov::io
