#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ifov/api.h"

namespace ifov {

struct ChannelDescription {
  std::string name;
  double centre_um = 0.0;  ///< wavelength of the response's middle
  double fwhm_um = 0.0;    ///< its full width at half maximum
};

struct ImageDescription {
  int width_px = 0, height_px = 0;
  std::vector<ChannelDescription> channels;
  std::vector<std::string> materials = {};  ///< of which abundances tell
  /// Where pixels are squares of the map: its coordinates at corners of pixels, as RasterAsset has them.
  std::optional<std::array<double, 6>> geotransform = {};
  std::string crs = {};             ///< well-known text; empty: it is not known where on the Earth this is
  std::uint64_t seed = 0;           ///< of the run
  std::string accuracy_asked = {};  ///< in words; empty: none
  double confidence = 0.0;          ///< of the intervals
};

/// What one value of each pixel, or some of them, is: what the cube of this name holds (docs/formats/products.md).
struct QuantityDescription {
  std::string name;                ///< as documents have it under output.products: "abundance"
  std::string what, unit;          ///< in words; "W m-2 sr-1 um-1", "count", "deg", "1"
  std::vector<std::string> bands;  ///< channels, materials or names of their own
};

/// Values of a quantity: [row][column][band], of the type of its cube.
struct TileQuantity {
  QuantityDescription description;
  std::variant<std::span<const float>, std::span<const double>, std::span<const std::uint32_t>,
               std::span<const std::uint16_t>, std::span<const std::uint8_t>>
      values;
};

/// A finished rectangle of an image. Arrays are row-major, rows from the top: [row][column][channel] at
/// (row * width_px + column) * channels + channel, and [row][column] where a pixel has one value. They are the library's,
/// and are gone when the call that hands the tile over is.
struct Tile {
  int x_px = 0, y_px = 0;  ///< of the upper left pixel in the image, from 0
  int width_px = 0, height_px = 0;
  int channels = 0;
  std::span<const float> radiance;  ///< [row][column][channel], W m-2 sr-1 um-1
  /// The same shape and unit: of the interval at the document's confidence; empty where the document's way of
  /// sampling knows no error.
  std::span<const float> half_width;
  std::span<const std::uint32_t> samples;  ///< [row][column]: points that were looked at
  /// [row][column]: why the pixel does not meet the accuracy; 0 where it does; bit k stands for reason_name(k), as in
  /// image_reasons.img.
  std::span<const std::uint16_t> reasons;
  /// What TileOptions::quantities asks for and there is, in the order of the cubes.
  std::span<const TileQuantity> quantities = {};
};

/// What a bit of Tile::reasons means: "samples", "air"; empty where there is no such bit.
IFOV_API std::string_view reason_name(int bit);

class IFOV_API TileSink {
 public:
  virtual ~TileSink() = default;
  /// Before the first tile.
  virtual void begin(const ImageDescription& image) { static_cast<void>(image); }
  /// In any order, from several threads at once; each pixel comes once. What it throws ends the run.
  virtual void write(const Tile& tile) = 0;
};

}  // namespace ifov
