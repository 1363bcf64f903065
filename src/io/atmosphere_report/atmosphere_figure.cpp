#include <algorithm>
#include <cmath>

#include "io/atmosphere_report/atmosphere_report.h"
#include "io/atmosphere_report/sky_picture.h"
#include "io/figures/axes.h"
#include "io/figures/palette.h"

namespace ifov::io {
namespace {

using atmosphere::AtmosphereEffects;

constexpr double kWidth = 1180.0, kLeft = 84.0, kPlotWidth = 690.0, kPlotHeight = 190.0, kGap = 52.0,
                 kTitle = 26.0;
constexpr double kSkyCentre = 960.0, kSkyRadius = 132.0;
/// Decades that a logarithmic axis shows below the brightest light.
constexpr double kDecades = 1e-4;

std::vector<CanvasPoint> points(const std::vector<AtmosphereEffects>& spectrum,
                                double AtmosphereEffects::*value) {
  std::vector<CanvasPoint> found;
  for (const AtmosphereEffects& step : spectrum) found.push_back({step.wavelength_um, step.*value});
  return found;
}

Axis logarithmic_axis(const std::vector<Curve>& curves) {
  double largest = 0.0, smallest = 1e300;
  for (const Curve& curve : curves)
    for (const CanvasPoint& p : curve.points) {
      largest = std::max(largest, p.y);
      if (p.y > 0.0) smallest = std::min(smallest, p.y);
    }
  if (!(largest > 0.0)) return {1e-3, 1.0, true};
  return {std::pow(10.0, std::floor(std::log10(std::max(smallest, kDecades * largest)))), 1.6 * largest,
          true};
}

/// Where the channels are, behind the curves.
void draw_channels(Canvas& canvas, const AtmosphereReport& report, const Plot& plot) {
  constexpr std::size_t kMost = 24;
  if (report.channels.size() > kMost) return;
  canvas.begin_clip(plot.x, plot.y, plot.width, plot.height);
  for (const AtmosphereReport::Channel& channel : report.channels) {
    const double left = plot.to_x(channel.first_um), right = plot.to_x(channel.last_um);
    canvas.fill_rectangle(left, plot.y, std::max(1.0, right - left), plot.height, {0.55, 0.6, 0.75, 0.16});
  }
  canvas.end_clip();
}

}  // namespace

std::string atmosphere_report_figure(const AtmosphereReport& report) {
  const std::vector<AtmosphereEffects>& spectrum = report.spectrum;
  const bool day = report.geometry.sun_zenith_rad.has_value();
  const double top = kTitle + 20.0 * static_cast<double>(report.description.size()) + 44.0;
  Canvas canvas(kWidth, top + 3.0 * kPlotHeight + 2.0 * kGap + 62.0);
  double line = kTitle;
  for (std::size_t k = 0; k < report.description.size(); ++k, line += 20.0)
    canvas.text({kLeft, line}, report.description[k], k == 0 ? 16.0 : 13.0, Anchor::left, k == 0);

  Axis across{spectrum.front().wavelength_um, spectrum.back().wavelength_um, false};
  across.logarithmic = across.last > 3.0 * across.first;
  std::vector<Curve> transmittance{
      {"ground to sensor", kBlueInk, false, points(spectrum, &AtmosphereEffects::view_transmittance)}};
  std::vector<Curve> path{
      {"emission of the air", kRedInk, false, points(spectrum, &AtmosphereEffects::thermal_path)}};
  std::vector<Curve> irradiance{
      {"emission of the sky", kRedInk, false, points(spectrum, &AtmosphereEffects::thermal_sky)}};
  if (day) {
    const std::string light = report.body == "Sun" ? "sunlight" : "moonlight";
    transmittance.insert(transmittance.begin(), {report.body + " to ground", kRedInk, false,
                                                 points(spectrum, &AtmosphereEffects::sun_transmittance)});
    path.insert(path.begin(),
                {"scattered " + light, kBlueInk, false, points(spectrum, &AtmosphereEffects::solar_path)});
    irradiance.insert(
        irradiance.begin(),
        {{report.body, kGreenInk, false, points(spectrum, &AtmosphereEffects::direct_irradiance)},
         {light + " from the sky", kBlueInk, false, points(spectrum, &AtmosphereEffects::solar_sky)}});
  }
  // What is dark everywhere has no curve.
  for (std::vector<Curve>* curves : {&path, &irradiance})
    std::erase_if(*curves, [](const Curve& curve) {
      return std::all_of(curve.points.begin(), curve.points.end(),
                         [](const CanvasPoint& p) { return p.y <= 0.0; });
    });
  const std::vector<Plot> plots{
      {kLeft, top, kPlotWidth, kPlotHeight, across, {0.0, 1.0, false}, "Transmittance"},
      {kLeft, top + kPlotHeight + kGap, kPlotWidth, kPlotHeight, across, logarithmic_axis(path),
       "Path, W m\u207b\u00b2 sr\u207b\u00b9 \u00b5m\u207b\u00b9"},
      {kLeft, top + 2.0 * (kPlotHeight + kGap), kPlotWidth, kPlotHeight, across, logarithmic_axis(irradiance),
       "On the ground, W m\u207b\u00b2 \u00b5m\u207b\u00b9", "Wavelength (\u00b5m)"}};
  const std::vector<const std::vector<Curve>*> curves{&transmittance, &path, &irradiance};
  for (std::size_t k = 0; k < plots.size(); ++k) {
    draw_channels(canvas, report, plots[k]);
    draw_axes(canvas, plots[k], wavelength_ticks(across, kPlotWidth), k + 1 == plots.size());
    draw_curves(canvas, plots[k], *curves[k]);
  }
  const double bottom = plots.back().y + kPlotHeight;
  canvas.text({kLeft, bottom + 56.0}, "Over black ground. Shaded: the sensor's channels.", 11.5, Anchor::left,
              false, kGreyInk);

  draw_sky(canvas, report, {kSkyCentre, top + kSkyRadius + 14.0}, kSkyRadius, SkyQuantity::brightness);
  if (!report.sky_is_thermal)
    draw_sky(canvas, report, {kSkyCentre, top + 3.0 * kSkyRadius + 110.0}, kSkyRadius,
             SkyQuantity::polarization);
  return canvas.png();
}

}  // namespace ifov::io
