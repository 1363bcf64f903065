#include "io/figures/material_plot.h"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <sstream>
#include <vector>

#include "core/error.h"

namespace ifov::io {
namespace {

constexpr double kScale = 2.0;  // pixels per unit
constexpr double kWidth = 840.0, kLeft = 70.0, kRight = 24.0, kTop = 62.0, kPlotHeight = 380.0, kAxis = 50.0;
constexpr double kLegendLine = 18.0, kFontSize = 13.0;
constexpr std::array kTicks{0.35, 0.5, 0.7, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 14.0};

struct Colour {
  double red, green, blue;
};
/// M. Okabe and K. Ito (2008): told apart by colour-blind readers too.
constexpr std::array<Colour, 6> kColours{{{0.00, 0.45, 0.70},
                                          {0.84, 0.37, 0.00},
                                          {0.00, 0.62, 0.45},
                                          {0.80, 0.47, 0.65},
                                          {0.34, 0.71, 0.91},
                                          {0.90, 0.62, 0.00}}};

struct Free {
  void operator()(cairo_t* p) const { cairo_destroy(p); }
  void operator()(cairo_surface_t* p) const { cairo_surface_destroy(p); }
};
using Context = std::unique_ptr<cairo_t, Free>;
using Surface = std::unique_ptr<cairo_surface_t, Free>;

enum class Anchor { left, centre, right };

void font(cairo_t* c, double size, bool bold) {
  cairo_select_font_face(c, "sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, size);
}

double text_width(cairo_t* c, const std::string& words) {
  cairo_text_extents_t extents;
  cairo_text_extents(c, words.c_str(), &extents);
  return extents.x_advance;
}

void text(cairo_t* c, double x, double y, const std::string& words, Anchor anchor = Anchor::left) {
  const double width = text_width(c, words);
  cairo_move_to(c, x - (anchor == Anchor::left ? 0.0 : anchor == Anchor::centre ? 0.5 * width : width), y);
  cairo_show_text(c, words.c_str());
}

/// Cuts words that are wider than there is room.
std::string fitted(cairo_t* c, std::string words, double width) {
  if (text_width(c, words) <= width) return words;
  while (!words.empty() && text_width(c, words + "...") > width) words.pop_back();
  return words + "...";
}

/// Words in as many lines as they need.
std::vector<std::string> lines_of(cairo_t* c, const std::string& words, double width) {
  std::vector<std::string> lines(1);
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || text_width(c, longer) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

void grey(cairo_t* c, double level) { cairo_set_source_rgb(c, level, level, level); }

/// The rectangle of the curves: wavelengths on a logarithmic axis, values from 0 to `top`.
struct Axes {
  double first_um, last_um, top;

  double x(double um) const {
    return kLeft + (kWidth - kLeft - kRight) * std::log(um / first_um) / std::log(last_um / first_um);
  }
  double y(double value) const { return kTop + kPlotHeight * (1.0 - value / top); }
};

void draw_axes(cairo_t* c, const Axes& axes, bool with_transmittance) {
  const double bottom = kTop + kPlotHeight, right = kWidth - kRight;
  const double step = axes.top > 0.5 ? 0.2 : axes.top > 0.25 ? 0.1 : axes.top > 0.1 ? 0.05 : 0.02;
  font(c, kFontSize, false);
  cairo_set_line_width(c, 0.8);
  for (int k = 0; k * step <= axes.top + 1e-9; ++k) {
    grey(c, 0.88);
    cairo_move_to(c, kLeft, axes.y(k * step));
    cairo_line_to(c, right, axes.y(k * step));
    cairo_stroke(c);
    grey(c, 0.15);
    text(c, kLeft - 9, axes.y(k * step) + 4.5, format("{:.{}f}", k * step, step < 0.1 ? 2 : 1),
         Anchor::right);
  }
  for (const double tick : kTicks) {
    grey(c, 0.88);
    cairo_move_to(c, axes.x(tick), kTop);
    cairo_line_to(c, axes.x(tick), bottom);
    cairo_stroke(c);
    grey(c, 0.15);
    text(c, axes.x(tick), bottom + 18, format("{:g}", tick), Anchor::centre);
  }
  cairo_set_line_width(c, 1.2);
  cairo_rectangle(c, kLeft, kTop, right - kLeft, kPlotHeight);
  cairo_stroke(c);
  font(c, kFontSize + 1, false);
  text(c, 0.5 * (kLeft + right), bottom + 40, "Wavelength (\u00b5m)", Anchor::centre);
  cairo_save(c);
  cairo_translate(c, 20, kTop + 0.5 * kPlotHeight);
  cairo_rotate(c, -M_PI / 2);
  text(c, 0, 0, with_transmittance ? "Reflectance, transmittance" : "Reflectance", Anchor::centre);
  cairo_restore(c);
}

bool is_lent(const LibraryCurve& curve, double um) {
  return std::any_of(curve.lent.begin(), curve.lent.end(),
                     [um](const LentRange& range) { return um >= range.first_um && um <= range.last_um; });
}

/// The parts of a spectrum that were (not) measured, as one path.
void draw_parts(cairo_t* c, const Axes& axes, const LibraryCurve& curve, const radiometry::Spectrum& spectrum,
                bool lent) {
  for (std::size_t i = 1; i < spectrum.values().size(); ++i) {
    const double from = spectrum.wavelength_um()[i - 1], to = spectrum.wavelength_um()[i];
    if (is_lent(curve, 0.5 * (from + to)) != lent) {
      cairo_new_sub_path(c);
      continue;
    }
    if (cairo_has_current_point(c) == 0) cairo_move_to(c, axes.x(from), axes.y(spectrum.values()[i - 1]));
    cairo_line_to(c, axes.x(to), axes.y(spectrum.values()[i]));
  }
}

void style(cairo_t* c, const Colour& colour, bool lent, bool dashed) {
  const double dashes[] = {6.0, 4.0};
  cairo_set_dash(c, dashes, dashed ? 2 : 0, 0.0);
  cairo_set_source_rgba(c, colour.red, colour.green, colour.blue, lent ? 0.5 : 1.0);
  cairo_set_line_width(c, lent ? 0.9 : 1.8);
}

void draw_curve(cairo_t* c, const Axes& axes, const LibraryCurve& curve, const Colour& colour) {
  for (const bool dashed : {false, true}) {
    if (dashed && !curve.transmittance) continue;
    for (const bool lent : {true, false}) {
      style(c, colour, lent, dashed);
      draw_parts(c, axes, curve, dashed ? *curve.transmittance : curve.reflectance, lent);
      cairo_stroke(c);
    }
  }
  cairo_set_dash(c, nullptr, 0, 0.0);
}

/// Colours of many curves repeat, dark the second time and light from then on.
Colour colour_of(std::size_t k) {
  const Colour& base = kColours[k % kColours.size()];
  const std::size_t round = k / kColours.size();
  const double share = round == 0 ? 0.0 : 0.45, towards = round == 1 ? 0.0 : 1.0;
  const auto blend = [&](double value) { return value + share * (towards - value); };
  return {blend(base.red), blend(base.green), blend(base.blue)};
}

cairo_status_t append(void* out, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

std::vector<std::string> about_lines(const LibraryMaterial& material) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1));
  const Context context(cairo_create(surface.get()));
  font(context.get(), kFontSize, false);
  return lines_of(context.get(), material.about, kWidth - kLeft - kRight);
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
  const double legend = kTop + kPlotHeight + kAxis + 20.0;
  const std::vector<std::string> about = about_lines(material);
  const double shift = kLegendLine * static_cast<double>(about.size() - 1);
  const double height = shift + legend + kLegendLine * static_cast<double>(curves.size() + 1) + 10.0;
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(kScale * kWidth),
                                                   static_cast<int>(kScale * height)));
  const Context context(cairo_create(surface.get()));
  cairo_t* c = context.get();
  cairo_scale(c, kScale, kScale);
  grey(c, 1.0);
  cairo_paint(c);
  grey(c, 0.1);
  font(c, 18, true);
  text(c, kLeft, 28, material.name);
  font(c, kFontSize, false);
  for (std::size_t k = 0; k < about.size(); ++k)
    text(c, kLeft, 49 + kLegendLine * static_cast<double>(k), about[k]);
  cairo_translate(c, 0.0, shift);

  const auto grid = material.curves.front().reflectance.wavelength_um();
  const Axes axes{grid.front(), grid.back(), top_of(material, curves)};
  draw_axes(c, axes, any_transmittance);
  cairo_save(c);
  cairo_rectangle(c, kLeft, kTop, kWidth - kLeft - kRight, kPlotHeight);
  cairo_clip(c);
  for (std::size_t k = 0; k < curves.size(); ++k)
    draw_curve(c, axes, material.curves[curves[k]], colour_of(k));
  cairo_restore(c);

  for (std::size_t k = 0; k < curves.size(); ++k) {
    const LibraryCurve& curve = material.curves[curves[k]];
    const double y = legend + kLegendLine * static_cast<double>(k);
    style(c, colour_of(k), false, false);
    cairo_move_to(c, kLeft, y - 4.5);
    cairo_line_to(c, kLeft + 28, y - 4.5);
    cairo_stroke(c);
    grey(c, 0.15);
    font(c, kFontSize, false);
    text(c, kLeft + 38, y, fitted(c, curve.name + ": " + curve.sample, kWidth - kLeft - kRight - 38));
  }
  grey(c, 0.4);
  font(c, kFontSize - 1, false);
  text(c, kLeft, legend + kLegendLine * static_cast<double>(curves.size()) + 4,
       std::string(any_transmittance ? "Solid: reflectance. Dashed: transmittance, by a model. " : "") +
           (any_lent ? "Thin and pale: not measured, but lent by another sample or continued." : ""));
  cairo_surface_flush(surface.get());
  std::string png;
  if (cairo_surface_write_to_png_stream(surface.get(), append, &png) != CAIRO_STATUS_SUCCESS)
    throw SystemError("the figure cannot be drawn or encoded as PNG");
  return png;
}

}  // namespace ifov::io
