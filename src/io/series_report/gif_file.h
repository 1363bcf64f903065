#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/envi/colour_map.h"

namespace ifov::io {

/// An animated GIF, frame by frame, that begins again at its end. Throws SystemError where it cannot be made.
class GifFile {
 public:
  using Palette = std::vector<Rgb>;  ///< 256 or fewer

  GifFile(int width, int height, const Palette& palette);
  ~GifFile();
  GifFile(const GifFile&) = delete;
  GifFile& operator=(const GifFile&) = delete;

  /// A frame by positions in the palette, row by row from the top; of it that is kept which differs from the one before.
  void add(std::span<const std::uint8_t> frame, int hundredths_of_s);
  /// The file. Nothing is added afterwards.
  std::string finish();

 private:
  struct Inside;
  Inside* inside_;
  int width_, height_;
  std::vector<std::uint8_t> before_;
};

}  // namespace ifov::io
