// Of a build without Cairo (IFOV_CAIRO=OFF), in place of canvas.cpp: no sheet can be had.
#include "core/error.h"
#include "io/figures/canvas.h"

namespace ifov::io {

struct Canvas::Parts {};

Canvas::Canvas(double, double) {
  throw SystemError("this ifov was built without Cairo (IFOV_CAIRO=OFF) and draws no figures");
}
Canvas::~Canvas() = default;

void Canvas::line(std::span<const CanvasPoint>, const Ink&, double, bool) {}
void Canvas::fill_rectangle(double, double, double, double, const Ink&) {}
void Canvas::frame(double, double, double, double, const Ink&, double) {}
void Canvas::circle(CanvasPoint, double, const Ink&, double) {}
void Canvas::disc(CanvasPoint, double, const Ink&) {}
void Canvas::text(CanvasPoint, const std::string&, double, Anchor, bool, const Ink&) {}
void Canvas::upright_text(CanvasPoint, const std::string&, double) {}
double Canvas::text_width(const std::string&, double, bool) const { return 0.0; }
void Canvas::picture(double, double, double, int, int, std::span<const Pixel>) {}
void Canvas::begin_clip(double, double, double, double) {}
void Canvas::end_clip() {}
std::vector<std::uint32_t> Canvas::pixels() const { return {}; }
std::string Canvas::png() const { return {}; }
std::string Canvas::svg() const { return {}; }
std::string Canvas::pdf() const { return {}; }

}  // namespace ifov::io
