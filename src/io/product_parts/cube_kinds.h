#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/product_parts/envi_header.h"
#include "io/product_parts/product_kinds.h"
#include "render/tile_sink.h"

namespace ifov::io {

/// What a cube holds, and so what its header says.
struct CubeKind {
  Product product{};
  std::string suffix;     ///< "_radiance"
  std::string what;       ///< "radiance"
  std::string unit;       ///< of the values; empty: the radiance unit
  bool spectral = false;  ///< bands are the channels; else they are named here
  std::vector<std::string> band_names;
  EnviType type = EnviType::float32;
};

CubeKind cube_kind(Product product, const render::ImageInfo& info);
std::size_t band_count(const CubeKind& kind, const render::ImageInfo& info);

/// What is left of a selection for this image, the radiance always: nothing of the air without errors of the air, no
/// abundances without materials.
ProductSet possible_products(ProductSet selection, const render::ImageInfo& info);

struct CubeSize {
  int width_px = 0, height_px = 0, bands = 0;
  int value_bytes = 4;
  std::uint64_t bytes() const;
};
/// Of each cube of such a selection.
std::vector<CubeSize> cube_sizes(ProductSet selection, const render::ImageInfo& info);

}  // namespace ifov::io
