#pragma once

#include <functional>
#include <span>

namespace ifov::io {

/// A raster that can be read one line of one band at a time, wherever it lies.
struct RasterView {
  int width = 0, height = 0, bands = 0;
  std::function<void(int line, int band, std::span<float> values)> read;
  explicit operator bool() const { return static_cast<bool>(read); }
};

/// The same in double precision.
struct WideView {
  int width = 0, height = 0, bands = 0;
  std::function<void(int line, int band, std::span<double> values)> read;
  explicit operator bool() const { return static_cast<bool>(read); }
};

}  // namespace ifov::io
