#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/products/envi_reader.h"

namespace ifov::io {

/// A part of an image: all pixels whose centres lie in a polygon, or those that a mask marks.
class ImageRegion {
 public:
  /// What a region's text is read against. `map` holds map coordinates of image points as map_info.h's geotransform().
  struct Image {
    int width_px = 0, height_px = 0;
    std::optional<std::array<double, 6>> map;
  };

  /// "x0,y0,x1,y1" is a rectangle, "x,y,x,y,x,y" and more the corners of a polygon, both in pixels from the outer corner of
  /// the upper left one; "map:" before either makes them map coordinates (of a rectangle, two opposite corners);
  /// "mask:FILE" is an ENVI raster of the image's size, whose first band is not 0 inside. InputError on anything else, and
  /// on regions that hold no pixel.
  static ImageRegion parse(const std::string& text, const Image& image);

  /// Lines [first_line, end_line) may hold pixels of the region.
  int first_line() const { return first_line_; }
  int end_line() const { return end_line_; }
  /// For each pixel of a line, whether it belongs.
  void select(int line, std::vector<std::uint8_t>& inside) const;

 private:
  void require_pixels(const std::string& text) const;

  int width_ = 0, first_line_ = 0, end_line_ = 0;
  std::vector<std::array<double, 2>> corners_;  ///< in pixels; empty: the mask
  std::optional<EnviReader> mask_;
};

}  // namespace ifov::io
