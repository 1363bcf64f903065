#pragma once

#include <string>
#include <string_view>

namespace ifov::test {

/// PNG files, base64, made with zlib: 2 x 2 cells, red (200, 40, 40) and green (40, 180, 40) above blue (40, 40, 200) and grey (128).
inline constexpr std::string_view kPicture =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAFklEQVR4nGM4oaGhsUWDQUPjRENDAwAeygS1j3oeYQAAAABJRU5ErkJggg==";
/// A palette of (10, 20, 30) and (200, 100, 50); 2 x 1 cells, of entries 1 and 0.
inline constexpr std::string_view kPalettePicture =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAMAAADD/I+4AAAABlBMVEUKFB7IZDJ3oLOcAAAAC0lEQVR4"
    "nGNgZAAAAAUAAtFmM3gAAAAASUVORK5CYII=";
/// The first one with alpha: the green cell is not there.
inline constexpr std::string_view kPictureWithHole =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAGklEQVR4nGM4oaHxX2OLBgODhsaJ/w0NDf8BPdYHsjH1Ox0AAAAASUVORK5CYII=";

inline std::string decoded(std::string_view base64) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char digit : base64) {
    if (digit == '=') break;
    bits = bits << 6 | static_cast<unsigned>(kDigits.find(digit));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255u);
  }
  return bytes;
}

}  // namespace ifov::test
