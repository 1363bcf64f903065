#include "image_arrays.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <limits>
#include <type_traits>

namespace ifov::python {
namespace {

constexpr std::uint16_t kTime = 4;  ///< reason_name(2)

template <class Value>
Value empty_of(const std::string& name) {
  if constexpr (std::is_floating_point_v<Value>) return std::numeric_limits<Value>::quiet_NaN();
  if (name == "reasons") return static_cast<Value>(kTime);
  return 0;
}

}  // namespace

void ImageArrays::begin(const ImageDescription& image) {
  image_ = image;
  radiance_ = {.name = "radiance", .what = "radiance", .unit = "W m-2 sr-1 um-1", .bands = {}};
  for (const ChannelDescription& channel : image.channels) radiance_.bands.push_back(channel.name);
  half_width_ = radiance_;
  half_width_.name = "half_width", half_width_.what = "half-width of the radiance's interval";
  reasons_ = {.name = "reasons", .what = "why pixels are not converged", .unit = "1", .bands = {"reasons"}};
}

template <class Value>
ImageArrays::Plane& ImageArrays::plane(const QuantityDescription& of, std::size_t bands, Value empty) {
  const std::scoped_lock lock(mutex_);
  for (const auto& plane : planes_)
    if (plane->of.name == of.name) return *plane;
  const std::size_t count = bands * static_cast<std::size_t>(image_.width_px) * image_.height_px;
  auto& plane = *planes_.emplace_back(std::make_unique<Plane>());
  plane.of = of;
  plane.bands = bands;
  plane.value_bytes = sizeof(Value);
  plane.type = nb::dtype<Value>();
  plane.values = std::make_shared_for_overwrite<std::byte[]>(count * sizeof(Value));
  std::fill_n(reinterpret_cast<Value*>(plane.values.get()), count, empty);
  return plane;
}

template <class Value>
void ImageArrays::put(const Tile& tile, const QuantityDescription& of, std::span<const Value> values) {
  const std::size_t pixels = static_cast<std::size_t>(tile.width_px) * tile.height_px;
  const std::size_t bands = pixels == 0 ? 0 : values.size() / pixels;
  if (bands == 0) return;
  auto* const to = reinterpret_cast<Value*>(plane<Value>(of, bands, empty_of<Value>(of.name)).values.get());
  const auto width = static_cast<std::size_t>(image_.width_px),
             height = static_cast<std::size_t>(image_.height_px);
  for (std::size_t band = 0; band < bands; ++band)
    for (std::size_t row = 0; row < static_cast<std::size_t>(tile.height_px); ++row) {
      const Value* from = values.data() + row * tile.width_px * bands + band;
      Value* line = to + (band * height + tile.y_px + row) * width + tile.x_px;
      for (int column = 0; column < tile.width_px; ++column) line[column] = from[column * bands];
    }
}

void ImageArrays::write(const Tile& tile) {
  put(tile, radiance_, tile.radiance);
  put(tile, half_width_, tile.half_width);
  put(tile, reasons_, tile.reasons);
  for (const TileQuantity& quantity : tile.quantities)
    if (quantity.description.name != "half_width" && quantity.description.name != "reasons")
      std::visit([&](const auto& values) { put(tile, quantity.description, values); }, quantity.values);
  if (!is_function(on_tile_)) return;
  // The lock comes before the GIL: it is never waited for by who holds that.
  const std::scoped_lock one_at_a_time(telling_);
  call_.guarded([&] { on_tile_(arrays(), tile.x_px, tile.y_px, tile.width_px, tile.height_px); });
}

nb::dict ImageArrays::arrays() {
  nb::dict all;
  const std::scoped_lock lock(mutex_);
  for (const auto& plane : planes_) {
    auto* const kept = new std::shared_ptr<std::byte[]>(plane->values);
    const nb::capsule owner(kept,
                            [](void* p) noexcept { delete static_cast<std::shared_ptr<std::byte[]>*>(p); });
    const std::size_t shape[3] = {plane->bands, static_cast<std::size_t>(image_.height_px),
                                  static_cast<std::size_t>(image_.width_px)};
    const nb::ndarray<nb::numpy> array(plane->values.get(), 3, shape, owner, nullptr, plane->type);
    all[plane->of.name.c_str()] = nb::make_tuple(array, plane->of.bands, plane->of.what, plane->of.unit);
  }
  return all;
}

nb::dict described(const ImageDescription& image) {
  nb::dict all;
  all["width"] = image.width_px;
  all["height"] = image.height_px;
  nb::list channels;
  for (const ChannelDescription& channel : image.channels)
    channels.append(nb::make_tuple(channel.name, channel.centre_um, channel.fwhm_um));
  all["channels"] = channels;
  all["materials"] = image.materials;
  all["geotransform"] = image.geotransform;
  all["crs"] = image.crs;
  all["seed"] = image.seed;
  all["accuracy_asked"] = image.accuracy_asked;
  all["confidence"] = image.confidence;
  return all;
}

}  // namespace ifov::python
