#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/envi/colour_map.h"

namespace ifov::io {

struct CanvasPoint {
  double x = 0.0, y = 0.0;
};

struct Ink {
  double red = 0.0, green = 0.0, blue = 0.0, alpha = 1.0;
};
inline constexpr Ink kBlackInk{0.12, 0.12, 0.12}, kGreyInk{0.4, 0.4, 0.4}, kGridInk{0.88, 0.88, 0.88};

enum class Anchor { left, centre, right };

/// A white sheet to draw figures on, in units of a screen's pixels from the upper left corner (points in a PDF); a PNG has
/// twice as many. Throws SystemError where there is no memory for it.
class Canvas {
 public:
  Canvas(double width, double height);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void line(std::span<const CanvasPoint> points, const Ink& ink, double width, bool dashed = false);
  void fill_rectangle(double x, double y, double width, double height, const Ink& ink);
  void frame(double x, double y, double width, double height, const Ink& ink, double line_width);
  void circle(CanvasPoint centre, double radius, const Ink& ink, double line_width);
  void disc(CanvasPoint centre, double radius, const Ink& ink);
  void text(CanvasPoint at, const std::string& words, double size, Anchor anchor = Anchor::left,
            bool bold = false, const Ink& ink = kBlackInk);
  /// Reads upwards, centred.
  void upright_text(CanvasPoint at, const std::string& words, double size);
  double text_width(const std::string& words, double size, bool bold = false) const;
  /// Picture of `columns` x `rows` colours, row by row from the top, each a square of `unit`, with its corner at (x, y);
  /// what is not opaque stays as it was.
  struct Pixel {
    Rgb colour;
    bool opaque = false;
  };
  void picture(double x, double y, double unit, int columns, int rows, std::span<const Pixel> pixels);

  /// What is drawn until end_clip() shows only inside the rectangle.
  void begin_clip(double x, double y, double width, double height);
  void end_clip();

  /// 0xRRGGBB, row by row from the top, one a unit.
  std::vector<std::uint32_t> pixels() const;
  std::string png() const;
  std::string svg() const;
  std::string pdf() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ifov::io
