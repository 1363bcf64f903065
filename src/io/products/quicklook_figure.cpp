// Left out of a build without Cairo (IFOV_CAIRO=OFF); quicklook_without_cairo.cpp takes its place.
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "core/error.h"
#include "io/products/quicklook.h"
#include "io/products/quicklook_picture.h"

namespace ifov::io {
namespace {

using Picture = QuicklookPicture;

constexpr int kWantedSide = 760;  // smaller images are enlarged by whole factors
constexpr double kMargin = 28.0, kTitle = 58.0, kLine = 19.0, kBar = 120.0;

struct Free {
  void operator()(cairo_t* p) const { cairo_destroy(p); }
  void operator()(cairo_surface_t* p) const { cairo_surface_destroy(p); }
};
using Context = std::unique_ptr<cairo_t, Free>;
using Surface = std::unique_ptr<cairo_surface_t, Free>;

/// Ticks at 1, 2 or 5 times a power of ten.
double nice_step(double span, int most) {
  const double raw = span / most, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double m : {1.0, 2.0, 5.0})
    if (m * power >= raw * 0.999999) return m * power;
  return 10.0 * power;
}

void text(cairo_t* c, double x, double y, double size, const std::string& words, bool bold = false) {
  cairo_select_font_face(c, "sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, size);
  cairo_move_to(c, x, y);
  cairo_show_text(c, words.c_str());
}

double text_width(cairo_t* c, double size, const std::string& words, bool bold = false) {
  cairo_select_font_face(c, "sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, size);
  cairo_text_extents_t extents;
  cairo_text_extents(c, words.c_str(), &extents);
  return extents.x_advance;
}

/// Lines of at most `width`, broken between words.
std::vector<std::string> wrapped(cairo_t* c, const std::string& words, double width) {
  std::vector<std::string> lines{""};
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    const std::string longer = lines.back().empty() ? word : format("{} {}", lines.back(), word);
    if (lines.back().empty() || text_width(c, 12, longer) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

Surface image_surface(int width, int height) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    throw SystemError(format("a picture of {} x {} cannot be made: {}", width, height,
                             cairo_status_to_string(cairo_surface_status(surface.get()))));
  return surface;
}

void draw_pixels(cairo_t* c, const Picture& p, double x, double y, double scale) {
  const Surface pixels = image_surface(p.width, p.height);
  cairo_surface_flush(pixels.get());
  unsigned char* rows = cairo_image_surface_get_data(pixels.get());
  const int stride = cairo_image_surface_get_stride(pixels.get());
  for (int row = 0; row < p.height; ++row)
    std::copy_n(p.pixels.data() + static_cast<std::ptrdiff_t>(row) * p.width, p.width,
                reinterpret_cast<std::uint32_t*>(rows + static_cast<std::ptrdiff_t>(row) * stride));
  cairo_surface_mark_dirty(pixels.get());
  cairo_save(c);
  cairo_translate(c, x, y);
  cairo_scale(c, scale, scale);
  cairo_set_source_surface(c, pixels.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(c), CAIRO_FILTER_NEAREST);
  cairo_paint(c);
  cairo_restore(c);
}

void draw_bar(cairo_t* c, const Picture& p, double x, double y, double height) {
  for (int k = 0; k < 256; ++k) {
    const Rgb colour = (*p.colours)[static_cast<std::size_t>(k)];
    cairo_set_source_rgb(c, colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
    cairo_rectangle(c, x, y + height * (255 - k) / 256.0, 18, height / 256.0 + 0.6);
    cairo_fill(c);
  }
  cairo_set_source_rgb(c, 0.2, 0.2, 0.2);
  const double span = p.range.high - p.range.low,
               step = nice_step(span, std::max(2, static_cast<int>(height / 70)));
  for (double tick = std::ceil(p.range.low / step) * step; tick <= p.range.high + 1e-9 * span; tick += step) {
    const double at = y + height * (1.0 - (tick - p.range.low) / span);
    cairo_rectangle(c, x + 18, at - 0.5, 5, 1);
    cairo_fill(c);
    text(c, x + 27, at + 4, 12, format("{:.6g}", std::abs(tick) < 1e-9 * span ? 0.0 : tick));
  }
}

/// A bar of a round length, about a fifth of the image.
void draw_scale(cairo_t* c, double px_per_m, double right, double y, double width) {
  const double length_m = nice_step(width / px_per_m / 5.0, 1);
  const std::string words = length_m >= 1000.0 ? format("{:g} km", length_m / 1000.0)
                            : length_m >= 1.0  ? format("{:g} m", length_m)
                                               : format("{:g} cm", length_m * 100.0);
  const double length = length_m * px_per_m;
  cairo_rectangle(c, right - length, y, length, 4);
  cairo_fill(c);
  text(c, right - length - text_width(c, 12, words) - 8, y + 7, 12, words);
}

cairo_status_t append(void* out, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string make_quicklook(const RasterView& radiance, const RunRecord& record,
                           const std::vector<int>& channels) {
  const int factor = averaging_factor(radiance.width, radiance.height);
  const Picture p = quicklook_picture(radiance, record, channels, factor);
  const int enlarge = std::max(1, kWantedSide / std::max(p.width, p.height));
  const double width = p.width * enlarge, height = p.height * enlarge;
  const double frame = std::max(width, 420.0);
  const double full = frame + (p.bar ? kBar : 0.0);
  std::vector<std::string> lines = p.caption;
  {
    const Surface scratch = image_surface(1, 1);
    const Context measure(cairo_create(scratch.get()));
    const std::string& said = record.outcome.accuracy_statement;
    for (const auto& line :
         wrapped(measure.get(), said.empty() ? "ifov " + record.identity.version : said, full))
      lines.push_back(line);
  }
  const double bottom = kLine * static_cast<double>(lines.size()) + (record.image.has_map ? 44.0 : 20.0);

  const Surface surface =
      image_surface(static_cast<int>(2 * kMargin + full), static_cast<int>(kTitle + height + bottom));
  const Context context(cairo_create(surface.get()));
  cairo_t* c = context.get();
  cairo_set_source_rgb(c, 1, 1, 1);
  cairo_paint(c);
  cairo_set_source_rgb(c, 0.1, 0.1, 0.1);
  const double title_size = 17.0 * std::min(1.0, full / text_width(c, 17, p.title, true));
  text(c, kMargin, 34, title_size, p.title, true);
  if (p.bar) {
    text(c, kMargin + frame + 22, kTitle - 10, 12, p.unit);
    draw_bar(c, p, kMargin + frame + 22, kTitle, height);
  }
  draw_pixels(c, p, kMargin, kTitle, enlarge);
  cairo_set_source_rgb(c, 0.25, 0.25, 0.25);
  double line = kTitle + height;
  if (record.image.has_map) {
    draw_scale(c, enlarge / (record.image.gsd_m * factor), kMargin + width, line + 12, width);
    line += 24.0;
  }
  for (const auto& words : lines) text(c, kMargin, line += kLine, 12, words);
  cairo_surface_flush(surface.get());
  std::string png;
  if (cairo_surface_write_to_png_stream(surface.get(), append, &png) != CAIRO_STATUS_SUCCESS)
    throw SystemError("the picture cannot be encoded as PNG");
  return png;
}

}  // namespace ifov::io
