#include "io/product_parts/cube_tile.h"

#include <vector>

namespace ifov::io {

void read_cube_tile(const std::function<void(std::uint64_t offset, void* to, std::size_t bytes)>& read_at,
                    const CubeLayout& layout, sampling::PixelRect tile, std::span<float> values) {
  const std::size_t across = static_cast<std::size_t>(tile.width()),
                    all_bands = static_cast<std::size_t>(layout.bands);
  if (layout.interleave == EnviInterleave::bip) {
    for (int row = 0; row < tile.height(); ++row)
      read_at(sizeof(float) * layout.place(tile.x0, tile.y0 + row, 0),
              values.data() + static_cast<std::size_t>(row) * across * all_bands,
              sizeof(float) * across * all_bands);
    return;
  }
  std::vector<float> line(across * all_bands);
  for (int row = 0; row < tile.height(); ++row) {
    if (tile.width() == layout.samples && layout.interleave == EnviInterleave::bil) {
      read_at(sizeof(float) * layout.place(0, tile.y0 + row, 0), line.data(), sizeof(float) * line.size());
    } else {
      for (int band = 0; band < layout.bands; ++band)
        read_at(sizeof(float) * layout.place(tile.x0, tile.y0 + row, band),
                line.data() + static_cast<std::size_t>(band) * across, sizeof(float) * across);
    }
    float* const to = values.data() + static_cast<std::size_t>(row) * across * all_bands;
    for (std::size_t band = 0; band < all_bands; ++band)
      for (std::size_t x = 0; x < across; ++x) to[x * all_bands + band] = line[band * across + x];
  }
}

}  // namespace ifov::io
