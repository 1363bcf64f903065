// Left out of a build without Cairo (IFOV_CAIRO=OFF); canvas_without_cairo.cpp takes its place.
#include "io/figures/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <numbers>

#include "core/error.h"

namespace ifov::io {
namespace {

constexpr double kScale = 2.0;  // pixels per unit

struct Free {
  void operator()(cairo_t* p) const { cairo_destroy(p); }
  void operator()(cairo_surface_t* p) const { cairo_surface_destroy(p); }
};
using Surface = std::unique_ptr<cairo_surface_t, Free>;

Surface checked(cairo_surface_t* made) {
  Surface surface(made);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    throw SystemError("the figure cannot be drawn: " +
                      std::string(cairo_status_to_string(cairo_surface_status(surface.get()))));
  return surface;
}

Surface image(cairo_format_t format, int width, int height) {
  return checked(cairo_image_surface_create(format, width, height));
}

void use(cairo_t* c, const Ink& ink) { cairo_set_source_rgba(c, ink.red, ink.green, ink.blue, ink.alpha); }

void font(cairo_t* c, double size, bool bold) {
  cairo_select_font_face(c, "sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, size);
}

cairo_status_t append(void* out, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

struct Canvas::Parts {
  double width, height;
  Surface surface;  // remembers what is drawn
  std::unique_ptr<cairo_t, Free> context;
  cairo_t* c() const { return context.get(); }

  /// All that was drawn, on a white sheet.
  void draw_on(cairo_surface_t* sheet, double scale) const {
    const std::unique_ptr<cairo_t, Free> target(cairo_create(sheet));
    use(target.get(), {1.0, 1.0, 1.0});
    cairo_paint(target.get());
    cairo_scale(target.get(), scale, scale);
    cairo_set_source_surface(target.get(), surface.get(), 0.0, 0.0);
    cairo_paint(target.get());
  }
  template <class Make>
  std::string vector_file(const Make& make) const {
    std::string bytes;
    const Surface sheet = checked(make(append, &bytes, width, height));
    draw_on(sheet.get(), 1.0);
    cairo_surface_finish(sheet.get());
    if (cairo_surface_status(sheet.get()) != CAIRO_STATUS_SUCCESS)
      throw SystemError("the figure cannot be written");
    return bytes;
  }
};

Canvas::Canvas(double width, double height) : parts_(std::make_unique<Parts>()) {
  parts_->width = width, parts_->height = height;
  const cairo_rectangle_t sheet{0.0, 0.0, width, height};
  parts_->surface = checked(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &sheet));
  parts_->context.reset(cairo_create(parts_->surface.get()));
  cairo_set_line_join(parts_->c(), CAIRO_LINE_JOIN_ROUND);
}

Canvas::~Canvas() = default;

void Canvas::line(std::span<const CanvasPoint> points, const Ink& ink, double width, bool dashed) {
  cairo_t* c = parts_->c();
  const double dashes[] = {6.0, 4.0};
  cairo_set_dash(c, dashes, dashed ? 2 : 0, 0.0);
  use(c, ink);
  cairo_set_line_width(c, width);
  cairo_new_path(c);
  for (const CanvasPoint& p : points) cairo_line_to(c, p.x, p.y);
  cairo_stroke(c);
  cairo_set_dash(c, nullptr, 0, 0.0);
}

void Canvas::fill_rectangle(double x, double y, double width, double height, const Ink& ink) {
  use(parts_->c(), ink);
  cairo_rectangle(parts_->c(), x, y, width, height);
  cairo_fill(parts_->c());
}

void Canvas::frame(double x, double y, double width, double height, const Ink& ink, double line_width) {
  use(parts_->c(), ink);
  cairo_set_line_width(parts_->c(), line_width);
  cairo_rectangle(parts_->c(), x, y, width, height);
  cairo_stroke(parts_->c());
}

void Canvas::circle(CanvasPoint centre, double radius, const Ink& ink, double line_width) {
  use(parts_->c(), ink);
  cairo_set_line_width(parts_->c(), line_width);
  cairo_new_path(parts_->c());
  cairo_arc(parts_->c(), centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_stroke(parts_->c());
}

void Canvas::disc(CanvasPoint centre, double radius, const Ink& ink) {
  use(parts_->c(), ink);
  cairo_new_path(parts_->c());
  cairo_arc(parts_->c(), centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(parts_->c());
}

double Canvas::text_width(const std::string& words, double size, bool bold) const {
  font(parts_->c(), size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(parts_->c(), words.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(CanvasPoint at, const std::string& words, double size, Anchor anchor, bool bold,
                  const Ink& ink) {
  const double width = text_width(words, size, bold);
  use(parts_->c(), ink);
  cairo_move_to(parts_->c(),
                at.x - (anchor == Anchor::left     ? 0.0
                        : anchor == Anchor::centre ? 0.5 * width
                                                   : width),
                at.y);
  cairo_show_text(parts_->c(), words.c_str());
}

void Canvas::upright_text(CanvasPoint at, const std::string& words, double size) {
  cairo_save(parts_->c());
  cairo_translate(parts_->c(), at.x, at.y);
  cairo_rotate(parts_->c(), -0.5 * std::numbers::pi);
  text({0.0, 0.0}, words, size, Anchor::centre);
  cairo_restore(parts_->c());
}

void Canvas::picture(double x, double y, double unit, int columns, int rows, std::span<const Pixel> pixels) {
  const Surface surface = image(CAIRO_FORMAT_ARGB32, columns, rows);
  cairo_surface_flush(surface.get());
  unsigned char* lines = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int row = 0; row < rows; ++row) {
    auto* to = reinterpret_cast<std::uint32_t*>(lines + static_cast<std::ptrdiff_t>(row) * stride);
    for (int k = 0; k < columns; ++k) {
      const Pixel& p = pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                              static_cast<std::size_t>(k)];
      to[k] = p.opaque ? 0xFF000000u | (std::uint32_t{p.colour.r} << 16) | (std::uint32_t{p.colour.g} << 8) |
                             p.colour.b
                       : 0u;
    }
  }
  cairo_surface_mark_dirty(surface.get());
  cairo_save(parts_->c());
  cairo_translate(parts_->c(), x, y);
  cairo_scale(parts_->c(), unit, unit);
  cairo_set_source_surface(parts_->c(), surface.get(), 0, 0);
  cairo_paint(parts_->c());
  cairo_restore(parts_->c());
}

void Canvas::begin_clip(double x, double y, double width, double height) {
  cairo_save(parts_->c());
  cairo_rectangle(parts_->c(), x, y, width, height);
  cairo_clip(parts_->c());
}

void Canvas::end_clip() { cairo_restore(parts_->c()); }

std::vector<std::uint32_t> Canvas::pixels() const {
  const int columns = static_cast<int>(parts_->width), rows = static_cast<int>(parts_->height);
  const Surface sheet = image(CAIRO_FORMAT_RGB24, columns, rows);
  parts_->draw_on(sheet.get(), 1.0);
  cairo_surface_flush(sheet.get());
  const unsigned char* const data = cairo_image_surface_get_data(sheet.get());
  const int stride = cairo_image_surface_get_stride(sheet.get());
  std::vector<std::uint32_t> pixels;
  pixels.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row) {
    const auto* line =
        reinterpret_cast<const std::uint32_t*>(data + static_cast<std::ptrdiff_t>(row) * stride);
    for (int k = 0; k < columns; ++k) pixels.push_back(line[k] & 0xFFFFFFu);
  }
  return pixels;
}

std::string Canvas::png() const {
  const Surface sheet = image(CAIRO_FORMAT_RGB24, static_cast<int>(kScale * parts_->width),
                              static_cast<int>(kScale * parts_->height));
  parts_->draw_on(sheet.get(), kScale);
  cairo_surface_flush(sheet.get());
  std::string bytes;
  if (cairo_surface_write_to_png_stream(sheet.get(), append, &bytes) != CAIRO_STATUS_SUCCESS)
    throw SystemError("the figure cannot be encoded as PNG");
  return bytes;
}

std::string Canvas::svg() const { return parts_->vector_file(cairo_svg_surface_create_for_stream); }

std::string Canvas::pdf() const {
  return parts_->vector_file([](cairo_write_func_t write, void* to, double width, double height) {
    cairo_surface_t* const sheet = cairo_pdf_surface_create_for_stream(write, to, width, height);
    cairo_pdf_surface_set_metadata(sheet, CAIRO_PDF_METADATA_CREATE_DATE,
                                   "2000-01-01T00:00:00Z");  // the same bytes each time
    return sheet;
  });
}

}  // namespace ifov::io
