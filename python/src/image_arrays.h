#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "call.h"
#include "ifov/tile.h"

namespace ifov::python {

/// Puts an image together from its tiles: [band][row][column], as datasets have it. Pixels that no tile brings are not a number,
/// or 0 where numbers are whole; the reason of those is that time ran out.
class ImageArrays final : public TileSink {
 public:
  /// `on_tile`: None, or called with (arrays, x, y, width, height) once a tile is in the arrays, one call at a time.
  ImageArrays(Call& call, nb::object on_tile) : call_(call), on_tile_(std::move(on_tile)) {}
  void begin(const ImageDescription& image) override;
  void write(const Tile& tile) override;

  const ImageDescription& image() const { return image_; }
  /// {name: (array, names of the bands, words, unit)}. With the GIL held.
  nb::dict arrays();

 private:
  struct Plane {
    QuantityDescription of;
    std::size_t bands = 0, value_bytes = 0;
    nb::dlpack::dtype type;
    std::shared_ptr<std::byte[]> values;
  };
  template <class Value>
  Plane& plane(const QuantityDescription& of, std::size_t bands, Value empty);
  template <class Value>
  void put(const Tile& tile, const QuantityDescription& of, std::span<const Value> values);

  Call& call_;
  nb::object on_tile_;
  ImageDescription image_;
  QuantityDescription radiance_, half_width_, reasons_;
  std::mutex mutex_, telling_;
  std::vector<std::unique_ptr<Plane>> planes_;
};

/// {"width": ..., "channels": [(name, um, um)], ...} for Python.
nb::dict described(const ImageDescription& image);

}  // namespace ifov::python
