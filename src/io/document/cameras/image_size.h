#pragma once

#include <algorithm>
#include <cmath>

namespace ifov::io {

template <class V>
struct SchemaType;

/// Columns and rows of an image.
struct ImageSize {
  int width_px = 0, height_px = 0;

  /// How many times as long the longer side is as this; at least 1.
  double times(int longest_px) const {
    return std::max(1.0, static_cast<double>(std::max(width_px, height_px)) / longest_px);
  }
  ImageSize divided(double factor) const {
    const auto side = [&](int px) { return std::max(1, static_cast<int>(std::lround(px / factor))); };
    return factor > 1.0 ? ImageSize{side(width_px), side(height_px)} : *this;
  }
};

/// [columns, rows], as many as an image may have.
SchemaType<ImageSize> image_size_type();

}  // namespace ifov::io
