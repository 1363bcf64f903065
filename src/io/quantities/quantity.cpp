#include "io/quantities/quantity.h"

#include "render/tile_sink.h"

namespace ifov::io {

int Quantity::band_count(const render::ImageInfo& image) const {
  switch (bands) {
    case Bands::channels: return static_cast<int>(image.channels.size());
    case Bands::stokes: return static_cast<int>(4 * image.channels.size());
    case Bands::materials: return static_cast<int>(image.materials.size());
    case Bands::named: break;
  }
  return static_cast<int>(band_names.size());
}

}  // namespace ifov::io
