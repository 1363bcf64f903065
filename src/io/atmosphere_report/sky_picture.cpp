#include "io/atmosphere_report/sky_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "io/figures/colour_scale.h"
#include "radiometry/planck.h"

namespace ifov::io {
namespace {

constexpr int kSide = 560;
constexpr double kBrightest = 0.985;  // quantile at the end of the scale: the aureole is brighter

using atmosphere::SkyView;
using radiometry::StokesVector;

/// Index of the interval that holds x, and the share of its upper end.
std::pair<std::size_t, double> bracket(const std::vector<double>& nodes, double x) {
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
  const std::size_t low = static_cast<std::size_t>(above - nodes.begin()) - 1;
  return {low, std::clamp((x - nodes[low]) / (nodes[low + 1] - nodes[low]), 0.0, 1.0)};
}

StokesVector light_at(const SkyView& sky, double zenith_rad, double azimuth_rad) {
  const auto [z, up] = bracket(sky.zenith_rad, zenith_rad);
  const auto [a, on] = bracket(sky.azimuth_rad, azimuth_rad);
  return (1.0 - up) * ((1.0 - on) * sky.at(z, a) + on * sky.at(z, a + 1)) +
         up * ((1.0 - on) * sky.at(z + 1, a) + on * sky.at(z + 1, a + 1));
}

double shown(const AtmosphereReport& report, const StokesVector& light, SkyQuantity quantity) {
  if (quantity == SkyQuantity::polarization) return 100.0 * radiometry::degree_of_linear_polarization(light);
  if (report.sky_is_thermal) return radiometry::brightness_temperature_k(report.sky->wavelength_um, light.i);
  return light.i;
}

Axis scale_of(const AtmosphereReport& report, SkyQuantity quantity) {
  std::vector<double> values;
  for (const StokesVector& light : report.sky->light) values.push_back(shown(report, light, quantity));
  std::sort(values.begin(), values.end());
  const double high = values[static_cast<std::size_t>(kBrightest * static_cast<double>(values.size() - 1))];
  if (quantity == SkyQuantity::polarization)
    return {0.0, std::max(10.0, 10.0 * std::ceil(values.back() / 10.0)), false};
  if (!report.sky_is_thermal) return {0.0, std::max(high, 1e-12), false};
  const double low = values.front();
  return {low, std::max(values.back(), low + 1.0), false};
}

const ColourMap& colours_of(const AtmosphereReport& report, SkyQuantity quantity) {
  return quantity == SkyQuantity::polarization || report.sky_is_thermal ? heat_colours()
                                                                        : sequential_colours();
}

/// Azimuth from north of the table's zero.
double sun_azimuth(const AtmosphereReport& report) { return report.sun_azimuth_rad.value_or(0.0); }

/// North is up and east on the left.
CanvasPoint on_disc(CanvasPoint centre, double radius, double zenith_rad, double azimuth_rad) {
  const double r = radius * zenith_rad / (0.5 * std::numbers::pi);
  return {centre.x - r * std::sin(azimuth_rad), centre.y - r * std::cos(azimuth_rad)};
}

void draw_disc(Canvas& canvas, const AtmosphereReport& report, CanvasPoint centre, double radius,
               SkyQuantity quantity, const Axis& scale) {
  const ColourMap& colours = colours_of(report, quantity);
  std::vector<Canvas::Pixel> pixels(static_cast<std::size_t>(kSide) * kSide);
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const double x = 2.0 * (column + 0.5) / kSide - 1.0, y = 1.0 - 2.0 * (row + 0.5) / kSide;
      const double distance = std::hypot(x, y);
      if (distance > 1.0) continue;
      const double azimuth =
          std::abs(std::remainder(std::atan2(-x, y) - sun_azimuth(report), 2.0 * std::numbers::pi));
      const double value =
          shown(report, light_at(*report.sky, 0.5 * std::numbers::pi * distance, azimuth), quantity);
      pixels[static_cast<std::size_t>(row) * kSide + static_cast<std::size_t>(column)] = {
          colour_at(colours, scale.position(value)), true};
    }
  canvas.picture(centre.x - radius, centre.y - radius, 2.0 * radius / kSide, kSide, kSide, pixels);
}

void draw_marks(Canvas& canvas, const AtmosphereReport& report, CanvasPoint centre, double radius) {
  const Ink pale{1.0, 1.0, 1.0, 0.45};
  for (const double share : {1.0 / 3.0, 2.0 / 3.0}) canvas.circle(centre, share * radius, pale, 0.8);
  canvas.circle(centre, radius, kBlackInk, 1.0);
  const char* const names[] = {"N", "E", "S", "W"};
  for (int k = 0; k < 4; ++k) {
    const CanvasPoint at = on_disc(centre, radius + 11.0, 0.5 * std::numbers::pi, 0.5 * k * std::numbers::pi);
    canvas.text({at.x, at.y + 4.5}, names[k], 12.0, Anchor::centre);
  }
  if (!report.geometry.sun_zenith_rad) return;
  const CanvasPoint sun = on_disc(centre, radius, *report.geometry.sun_zenith_rad, sun_azimuth(report));
  canvas.disc(sun, 5.0, {1.0, 1.0, 1.0});
  canvas.circle(sun, 5.0, kBlackInk, 1.0);
}

void draw_neutral_points(Canvas& canvas, const AtmosphereReport& report, CanvasPoint centre, double radius) {
  constexpr double kArm = 4.5, kStroke = 1.4;
  const Ink white{1.0, 1.0, 1.0};
  for (const atmosphere::NeutralPoint& point : report.neutral_points) {
    const CanvasPoint at = on_disc(centre, radius, point.zenith_rad, sun_azimuth(report));
    canvas.fill_rectangle(at.x - kArm, at.y - 0.5 * kStroke, 2.0 * kArm, kStroke, white);
    canvas.fill_rectangle(at.x - 0.5 * kStroke, at.y - kArm, kStroke, 2.0 * kArm, white);
  }
}

}  // namespace

void draw_sky(Canvas& canvas, const AtmosphereReport& report, CanvasPoint centre, double radius,
              SkyQuantity quantity) {
  const Axis scale = scale_of(report, quantity);
  draw_disc(canvas, report, centre, radius, quantity, scale);
  draw_marks(canvas, report, centre, radius);
  const bool marks_points = quantity == SkyQuantity::polarization && !report.neutral_points.empty();
  if (marks_points) draw_neutral_points(canvas, report, centre, radius);
  draw_colour_scale(canvas, colours_of(report, quantity), scale, centre.x + radius + 28.0,
                    centre.y - 0.8 * radius, 1.6 * radius);
  const std::string what = quantity == SkyQuantity::polarization ? "Degree of linear polarization, %"
                           : report.sky_is_thermal
                               ? "Brightness temperature of the sky, K"
                               : "Sky radiance, W m\u207b\u00b2 sr\u207b\u00b9 \u00b5m\u207b\u00b9";
  canvas.text({centre.x, centre.y + radius + 36.0}, what, 13.0, Anchor::centre);
  canvas.text({centre.x, centre.y + radius + 53.0},
              format("{}, {:.4g} \u00b5m{}{}", report.sky_channel, report.sky->wavelength_um,
                     report.geometry.sun_zenith_rad ? "; white: the " + report.body : std::string(),
                     marks_points ? "; +: neutral points" : ""),
              12.0, Anchor::centre, false, kGreyInk);
}

}  // namespace ifov::io
