#include "io/figures/canvas.h"

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

Surface image(cairo_format_t format, int width, int height) {
  Surface surface(cairo_image_surface_create(format, width, height));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    throw EnvironmentError("the figure cannot be drawn: " +
                           std::string(cairo_status_to_string(cairo_surface_status(surface.get()))));
  return surface;
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
  Surface surface;
  std::unique_ptr<cairo_t, Free> context;
  cairo_t* c() const { return context.get(); }
};

Canvas::Canvas(double width, double height) : parts_(std::make_unique<Parts>()) {
  parts_->surface =
      image(CAIRO_FORMAT_RGB24, static_cast<int>(kScale * width), static_cast<int>(kScale * height));
  parts_->context.reset(cairo_create(parts_->surface.get()));
  cairo_scale(parts_->c(), kScale, kScale);
  use(parts_->c(), {1.0, 1.0, 1.0});
  cairo_paint(parts_->c());
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

void Canvas::picture(double x, double y, double size, int side, std::span<const Pixel> pixels) {
  const Surface surface = image(CAIRO_FORMAT_ARGB32, side, side);
  cairo_surface_flush(surface.get());
  unsigned char* rows = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int row = 0; row < side; ++row) {
    auto* to = reinterpret_cast<std::uint32_t*>(rows + static_cast<std::ptrdiff_t>(row) * stride);
    for (int k = 0; k < side; ++k) {
      const Pixel& p = pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
                              static_cast<std::size_t>(k)];
      to[k] = p.opaque ? 0xFF000000u | (std::uint32_t{p.colour.r} << 16) | (std::uint32_t{p.colour.g} << 8) |
                             p.colour.b
                       : 0u;
    }
  }
  cairo_surface_mark_dirty(surface.get());
  cairo_save(parts_->c());
  cairo_translate(parts_->c(), x, y);
  cairo_scale(parts_->c(), size / side, size / side);
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

std::string Canvas::png() const {
  cairo_surface_flush(parts_->surface.get());
  std::string bytes;
  if (cairo_surface_write_to_png_stream(parts_->surface.get(), append, &bytes) != CAIRO_STATUS_SUCCESS)
    throw EnvironmentError("the figure cannot be encoded as PNG");
  return bytes;
}

}  // namespace ifov::io
