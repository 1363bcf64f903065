#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "io/brdf_report/brdf_report.h"
#include "io/brdf_report/polar_map.h"
#include "io/figures/palette.h"
#include "io/figures/words.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

constexpr double kSheet = 1160.0, kFirstColumn = 84.0, kPanelWidth = 560.0, kLobesHeight = 330.0,
                 kSharesHeight = 220.0;
constexpr double kSecondColumn = kFirstColumn + kPanelWidth + 96.0,
                 kSecondWidth = kSheet - kSecondColumn - 30.0;
constexpr double kMapRadius = 142.0, kMapCentre = kSecondColumn + kMapRadius - 6.0;
constexpr double kAboveShares = 100.0, kBelow = 54.0, kLine = 19.0, kTextSize = 13.0;
/// Views beyond this do not set the axes: many models grow there without bound, and little is seen from there.
constexpr double kLastOnAxis_deg = 80.0;
/// Where the largest BRDF is so many times the smallest the axis is logarithmic, over at most so many decades.
constexpr double kLogarithmicFrom = 40.0, kDecades = 6.0;
constexpr double kTall = 1.06;  // of the largest value: the upper end of an axis

struct Values {
  double low = 1e300, high = 0.0;
  void add(double value) {
    if (!(value >= 0.0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  Axis axis() const {
    if (!(high > 0.0)) return {0.0, 1.0, false};
    if (!(high > kLogarithmicFrom * low)) return {0.0, kTall * high, false};
    const double least = std::max(low, high * std::pow(10.0, -kDecades));
    return {std::pow(10.0, std::floor(std::log10(least))), std::pow(10.0, std::ceil(std::log10(high) - 1e-9)),
            true};
  }
};

Axis lobes_axis(const BrdfReport& report) {
  Values values;
  for (const BrdfReport::Lobe& lobe : report.lobes)
    for (std::size_t v = 0; v < lobe.brdf.size(); ++v)
      if (std::abs(report.view_rad[v]) <= kLastOnAxis_deg * math::kDegree) values.add(lobe.brdf[v]);
  return values.axis();
}

Axis map_axis(const BrdfReport::Map& map) {
  Values values;
  for (int row = 0; row < map.side; ++row)
    for (int column = 0; column < map.side; ++column) {
      const double across = 2.0 * (column + 0.5) / map.side - 1.0, up = 2.0 * (row + 0.5) / map.side - 1.0;
      if (std::hypot(across, up) <= kLastOnAxis_deg / 90.0)
        values.add(map.brdf[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.side) +
                            static_cast<std::size_t>(column)]);
    }
  // Colours tell apart what there is; what hardly varies is one colour.
  constexpr double kVaries = 1.02;
  const Axis axis = values.axis();
  if (axis.logarithmic || !(values.high > 0.0)) return axis;
  return {values.high > kVaries * values.low ? values.low : 0.0, values.high, false};
}

void draw_lobes(Canvas& canvas, const BrdfReport& report, double top) {
  const Plot plot{.x = kFirstColumn,
                  .y = top,
                  .width = kPanelWidth,
                  .height = kLobesHeight,
                  .across = {-90.0, 90.0},
                  .up = lobes_axis(report),
                  .label = "BRDF (sr\u207b\u00b9)",
                  .label_across = "View zenith angle in the principal plane (deg); dashed: the light"};
  draw_axes(canvas, plot, {-90.0, -60.0, -30.0, 0.0, 30.0, 60.0, 90.0}, true);
  std::vector<Curve> curves;
  for (std::size_t k = 0; k < report.lobes.size(); ++k) {
    const BrdfReport::Lobe& lobe = report.lobes[k];
    const double light_deg = lobe.light_rad / math::kDegree, x = plot.to_x(light_deg);
    curves.push_back({format("light at {:g}\u00b0", light_deg), curve_ink(k), false, {}, 1.8});
    for (std::size_t v = 0; v < lobe.brdf.size(); ++v)
      curves.back().points.push_back({report.view_rad[v] / math::kDegree, lobe.brdf[v]});
    // Where the light is.
    canvas.line(std::vector<CanvasPoint>{{x, top}, {x, top + kLobesHeight}}, curve_ink(k), 0.9, true);
  }
  draw_curves(canvas, plot, curves);
}

Plot shares_plot(double x, double top, double width, const Axis& across, const std::string& label_across) {
  return {.x = x,
          .y = top,
          .width = width,
          .height = kSharesHeight,
          .across = across,
          .up = {0.0, 1.0},
          .label = "Reflectance, emissivity",
          .label_across = label_across};
}

/// Reflectance, transmittance and emissivity of a report or of one of its spectra, over x in units of `unit`.
template <class Of>
std::vector<Curve> shares(const std::vector<double>& x, double unit, const Of& of, double width) {
  std::vector<Curve> curves;
  const auto add = [&](const char* name, const Ink& ink, bool dashed, const std::vector<double>& values) {
    if (values.empty()) return;
    curves.push_back({name, ink, dashed, {}, width});
    for (std::size_t k = 0; k < values.size(); ++k) curves.back().points.push_back({x[k] / unit, values[k]});
  };
  add("reflectance", kBlueInk, false, of.reflectance);
  add("transmittance", kGreenInk, false, of.transmittance);
  add("emissivity", kRedInk, true, of.emissivity);
  return curves;
}

void draw_by_angle(Canvas& canvas, const BrdfReport& report, double top) {
  const Plot plot = shares_plot(kFirstColumn, top, kPanelWidth, {0.0, 90.0},
                                "Zenith angle of the light, or of the view for emissivity (deg)");
  draw_axes(canvas, plot, {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0}, true);
  draw_curves(canvas, plot, shares(report.zenith_rad, math::kDegree, report, 1.8));
}

void draw_by_wavelength(Canvas& canvas, const BrdfReport& report, double top) {
  Axis across{report.spectrum_um.front(), report.spectrum_um.back(), false};
  across.logarithmic = across.last > 3.0 * across.first;
  std::string label = "Wavelength (\u00b5m)";
  if (report.spectra.size() > 1)
    label += format("; thick: {:g}\u00b0, thin: {:g}\u00b0 from the normal",
                    report.spectra.front().zenith_rad / math::kDegree,
                    report.spectra.back().zenith_rad / math::kDegree);
  const Plot plot = shares_plot(kSecondColumn, top, kSecondWidth, across, label);
  draw_axes(canvas, plot, wavelength_ticks(across, plot.width), true);
  if (report.wavelength_um) {
    const double x = plot.to_x(*report.wavelength_um);
    canvas.line(std::vector<CanvasPoint>{{x, top}, {x, top + kSharesHeight}}, kGreyInk, 1.0);
  }
  for (std::size_t k = report.spectra.size(); k-- > 1;)
    draw_lines(canvas, plot, shares(report.spectrum_um, 1.0, report.spectra[k], 0.9));
  draw_curves(canvas, plot, shares(report.spectrum_um, 1.0, report.spectra.front(), 1.8));
}

}  // namespace

std::string brdf_figure(const BrdfReport& report) {
  std::vector<std::string> lines;
  const Canvas measure(1.0, 1.0);
  for (const std::string& line : report.description)
    for (const std::string& part : wrapped(measure, line, kTextSize, kSheet - kFirstColumn - 30.0))
      lines.push_back(part);
  const double about = 30.0 + kLine * static_cast<double>(lines.size());
  const double lobes = about + 40.0;
  const double shares = report.is_delta ? lobes : lobes + kLobesHeight + kAboveShares;
  const bool has_spectra = !report.spectra.empty() && report.spectrum_um.size() > 1;
  Canvas canvas(kSheet, shares + kSharesHeight + kBelow);
  std::string title = report.name == report.model ? report.model : report.name + ": " + report.model;
  if (report.wavelength_um) title += format(" at {:g} \u00b5m", *report.wavelength_um);
  canvas.text({kFirstColumn, 30.0}, title, 17.0, Anchor::left, true);
  for (std::size_t k = 0; k < lines.size(); ++k)
    canvas.text({kFirstColumn, 30.0 + kLine * static_cast<double>(k + 1)}, lines[k], kTextSize);
  if (!report.is_delta) {
    draw_lobes(canvas, report, lobes);
    if (report.map)
      draw_polar_map(canvas, *report.map, map_axis(*report.map), {kMapCentre, lobes + kMapRadius + 6.0},
                     kMapRadius);
  }
  draw_by_angle(canvas, report, shares);
  if (has_spectra) draw_by_wavelength(canvas, report, shares);
  return canvas.png();
}

}  // namespace ifov::io
