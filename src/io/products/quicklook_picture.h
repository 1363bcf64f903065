#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/envi/colour_map.h"
#include "io/product_parts/picture.h"
#include "io/product_parts/raster_view.h"
#include "io/product_parts/run_record.h"

namespace ifov::io {

/// What a quicklook shows, before it is drawn.
struct QuicklookPicture {
  std::string title, unit;
  std::vector<std::string> caption;
  Range range;  // of the colour bar
  bool bar = false;
  const ColourMap* colours = nullptr;
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;  // 0xRRGGBB
};

/// Of so many pixels to each side that the picture shows as one; `channels` as for make_quicklook().
QuicklookPicture quicklook_picture(const RasterView& radiance, const RunRecord& record,
                                   const std::vector<int>& channels, int factor);

}  // namespace ifov::io
