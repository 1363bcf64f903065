#include "io/figures/material_plot.h"

#include <algorithm>
#include <vector>

#include "io/figures/axes.h"
#include "io/figures/palette.h"
#include "io/figures/words.h"

namespace ifov::io {
namespace {

constexpr double kWidth = 840.0, kLeft = 70.0, kRight = 24.0, kTop = 62.0, kPlotHeight = 380.0, kAxis = 50.0;
constexpr double kLegendLine = 18.0, kLegendSize = 13.0;
const std::vector<double> kTicks_um{0.35, 0.5, 0.7, 1.0, 1.5,  2.0,  2.5, 3.0,
                                    4.0,  5.0, 6.0, 8.0, 10.0, 12.0, 14.0};

bool is_lent(const LibraryCurve& curve, double um) {
  return std::any_of(curve.lent.begin(), curve.lent.end(),
                     [um](const LentRange& range) { return um >= range.first_um && um <= range.last_um; });
}

/// The stretches of a spectrum that were measured, or those that were not, which are thin and pale.
void add_stretches(std::vector<Curve>& lines, const LibraryCurve& curve, const radiometry::Spectrum& spectrum,
                   const Ink& ink, bool dashed, bool lent) {
  const Curve style{{}, {ink.red, ink.green, ink.blue, lent ? 0.5 : 1.0}, dashed, {}, lent ? 0.9 : 1.8};
  bool goes_on = false;
  for (std::size_t i = 1; i < spectrum.values().size(); ++i) {
    const CanvasPoint from{spectrum.wavelength_um()[i - 1], spectrum.values()[i - 1]};
    const CanvasPoint to{spectrum.wavelength_um()[i], spectrum.values()[i]};
    if (is_lent(curve, 0.5 * (from.x + to.x)) != lent) {
      goes_on = false;
      continue;
    }
    if (!goes_on) {
      lines.push_back(style);
      lines.back().points.push_back(from);
      goes_on = true;
    }
    lines.back().points.push_back(to);
  }
}

std::vector<Curve> lines_of(const LibraryCurve& curve, const Ink& ink) {
  std::vector<Curve> lines;
  for (const bool lent : {true, false}) {
    add_stretches(lines, curve, curve.reflectance, ink, false, lent);
    if (curve.transmittance) add_stretches(lines, curve, *curve.transmittance, ink, true, lent);
  }
  return lines;
}

double top_of(const LibraryMaterial& material, std::span<const std::size_t> curves) {
  double largest = 0.0;
  for (const std::size_t k : curves) {
    largest = std::max(largest, material.curves[k].reflectance.maximum());
    if (material.curves[k].transmittance)
      largest = std::max(largest, material.curves[k].transmittance->maximum());
  }
  for (const double top : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8})
    if (largest < 0.97 * top) return top;
  return 1.0;
}

}  // namespace

std::string plot_material(const LibraryMaterial& material, std::span<const std::size_t> curves) {
  const bool any_transmittance = std::any_of(curves.begin(), curves.end(), [&](std::size_t k) {
    return material.curves[k].transmittance.has_value();
  });
  const bool any_lent = std::any_of(curves.begin(), curves.end(),
                                    [&](std::size_t k) { return !material.curves[k].lent.empty(); });
  const double width = kWidth - kLeft - kRight;
  const std::vector<std::string> about = wrapped(Canvas(1.0, 1.0), material.about, kLegendSize, width);
  const double top = kTop + kLegendLine * static_cast<double>(about.size() - 1);
  const double legend = top + kPlotHeight + kAxis + 20.0;
  Canvas canvas(kWidth, legend + kLegendLine * static_cast<double>(curves.size() + 1) + 10.0);
  canvas.text({kLeft, 28.0}, material.name, 18.0, Anchor::left, true);
  for (std::size_t k = 0; k < about.size(); ++k)
    canvas.text({kLeft, 49.0 + kLegendLine * static_cast<double>(k)}, about[k], kLegendSize);

  const auto grid = material.curves.front().reflectance.wavelength_um();
  const Plot plot{.x = kLeft,
                  .y = top,
                  .width = width,
                  .height = kPlotHeight,
                  .across = {grid.front(), grid.back(), true},
                  .up = {0.0, top_of(material, curves)},
                  .label = any_transmittance ? "Reflectance, transmittance" : "Reflectance",
                  .label_across = "Wavelength (\u00b5m)"};
  draw_axes(canvas, plot, kTicks_um, true);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const LibraryCurve& curve = material.curves[curves[k]];
    draw_lines(canvas, plot, lines_of(curve, curve_ink(k)));
    const double y = legend + kLegendLine * static_cast<double>(k), middle = y - 4.5;
    canvas.line(std::vector<CanvasPoint>{{kLeft, middle}, {kLeft + 28.0, middle}}, curve_ink(k), 1.8);
    canvas.text({kLeft + 38.0, y},
                fitted(canvas, curve.name + ": " + curve.sample, kLegendSize, width - 38.0), kLegendSize);
  }
  canvas.text(
      {kLeft, legend + kLegendLine * static_cast<double>(curves.size()) + 4.0},
      std::string(any_transmittance ? "Solid: reflectance. Dashed: transmittance, by a model. " : "") +
          (any_lent ? "Thin and pale: not measured, but lent by another sample or continued." : ""),
      kLegendSize - 1.0, Anchor::left, false, kGreyInk);
  return canvas.png();
}

}  // namespace ifov::io
